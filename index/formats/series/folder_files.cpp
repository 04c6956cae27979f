// Sorts the files of a folder into series.
#include "index/formats/series/folder_files.h"

#include "index/error.h"
#include "index/formats/known_formats.h"
#include "index/formats/series/dicom_files.h"
#include "index/formats/series/natural_order.h"
#include "index/formats/text_header.h"
#include "index/lower_case.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

/// Files of the first kind name files of the others.
struct NamesOthers {
    std::string_view extension;
    std::array<std::string_view, 4> others;
};

constexpr std::array kNamesOthers{
    NamesOthers{".xmf", {".h5", ".hdf5", ".hdf", ".raw"}},
    NamesOthers{".xdmf", {".h5", ".hdf5", ".hdf", ".raw"}},
    NamesOthers{".pvti", {".vti"}},
    NamesOthers{".pvtr", {".vtr"}},
    NamesOthers{".pvtu", {".vtu"}},
    NamesOthers{".pvts", {".vts"}},
    NamesOthers{".vtm", {".vti", ".vtr", ".vtu", ".vts"}},
    NamesOthers{".vth", {".vti"}},
    NamesOthers{".hdr", {".img"}},
    NamesOthers{".hdr.gz", {".img.gz"}},
};

std::string extension_of(const fs::path& path) {
    const std::string extension = lower_case(path.extension().string());
    return extension == ".gz" ? lower_case(path.stem().extension().string()) + extension
                              : extension;
}

/// Whether a file is as large as some steps of raw values.
bool fits_raw(const fs::path& path, const ReadOptions& options) {
    std::error_code error;
    const std::uint64_t size = fs::file_size(path, error);
    std::uint64_t step = options.type ? size_of(*options.type) : 0;
    for (const std::uint32_t count : *options.dims)
        step *= count;
    return !error && step > 0 && size > options.header_bytes &&
           (size - options.header_bytes) % step == 0;
}

bool holds_values(const fs::path& path, const ReadOptions& options) {
    if (options.dims)
        return fits_raw(path, options);
    // A raw file without dimensions belongs to a header beside it, or cannot be read.
    return lists_files(path) ||
           (extension_of(path) != ".raw" && (format_of(path) || is_dicom(path)));
}

/// All files with values, hidden ones left out; of a Zarr folder itself alone.
std::vector<fs::path> values_within(const fs::path& folder, const ReadOptions& options) {
    constexpr std::size_t kMost = 1'000'000;
    constexpr int kDeepest = 3;
    std::vector<fs::path> found;
    std::error_code error;
    std::size_t seen = 0;
    fs::recursive_directory_iterator at(folder, error);
    if (error)
        throw Error(
            fmt::format("{}: the folder cannot be read: {}", folder.string(), error.message()));
    for (const fs::recursive_directory_iterator end; !error && at != end; at.increment(error)) {
        const fs::path& path = at->path();
        if (++seen > kMost)
            throw Error(fmt::format("{}: more than {} files in it", folder.string(), kMost));
        std::error_code ignored;
        if (path.filename().string().starts_with('.')) {
            at.disable_recursion_pending();
        } else if (at->is_directory(ignored)) {
            if (described_in(path) != path)
                found.push_back(path);
            if (described_in(path) != path || at.depth() >= kDeepest)
                at.disable_recursion_pending();
        } else if (at->is_regular_file(ignored) && holds_values(path, options)) {
            found.push_back(path);
        }
    }
    return found;
}

void drop_named(std::vector<fs::path>& files) {
    std::set<std::string> there, named;
    for (const fs::path& file : files)
        there.insert(extension_of(file));
    for (const NamesOthers& each : kNamesOthers)
        if (there.contains(std::string(each.extension)))
            named.insert(each.others.begin(), each.others.end());
    std::erase_if(files, [&](const fs::path& file) { return named.contains(extension_of(file)); });
}

/// What the names of a series have in common, as a pattern.
std::string pattern_of(const fs::path& path) {
    std::string pattern;
    for (const char c : path.string())
        if (c < '0' || c > '9')
            pattern += c;
        else if (pattern.empty() || pattern.back() != '*')
            pattern += '*';
    return pattern;
}

std::string some_of(const std::vector<std::string>& names) {
    constexpr std::size_t kShown = 6;
    const auto shown = static_cast<std::ptrdiff_t>(std::min(names.size(), kShown));
    std::string text = fmt::format("{}", fmt::join(names.begin(), names.begin() + shown, ", "));
    if (names.size() > kShown)
        text += fmt::format(" and {} more", names.size() - kShown);
    return text;
}

} // namespace

FolderFiles files_in_folder(const fs::path& folder, const ReadOptions& options) {
    std::vector<fs::path> files = values_within(folder, options);
    if (files.empty())
        throw Error(fmt::format("{}: a folder without {}", folder.string(),
                                options.dims ? "a file as large as --dims and --type say"
                                             : "a file of values of a known format; raw values "
                                               "need --dims and --type"));
    if (std::ranges::any_of(files, lists_files))
        std::erase_if(files, [](const fs::path& file) { return !lists_files(file); });
    drop_named(files);
    std::ranges::sort(files, [](const fs::path& a, const fs::path& b) {
        return natural_less(a.string(), b.string());
    });
    std::map<std::string, std::vector<fs::path>> series;
    for (const fs::path& file : files)
        series[pattern_of(file.lexically_relative(folder))].push_back(file);
    const auto is_series = [](const auto& each) { return each.second.size() > 1; };
    const bool list = lists_files(files.front());
    if (list ? files.size() == 1 : series.size() == 1)
        return {files, std::nullopt};
    if (list || std::ranges::count_if(series, is_series) != 1) {
        std::vector<std::string> listed;
        for (const auto& [pattern, of_it] : series)
            listed.push_back(
                of_it.size() == 1
                    ? fmt::format("'{}'", of_it.front().string())
                    : fmt::format("'{}' ({} files)", (folder / pattern).string(), of_it.size()));
        throw Error(fmt::format("{}: a folder with several series or files, expected one: {}",
                                folder.string(), some_of(listed)));
    }
    std::vector<std::string> left;
    for (const auto& [pattern, of_it] : series)
        if (of_it.size() == 1)
            left.push_back(of_it.front().lexically_relative(folder).string());
    return {std::ranges::find_if(series, is_series)->second,
            fmt::format("left out of {}: {}", folder.string(), some_of(left))};
}

} // namespace isochron::index
