// Finds the files of folders, and sorts them into series.
#include "index/formats/series/folder_files.h"

#include "index/error.h"
#include "index/formats/series/numbered_name.h"
#include "index/lower_case.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

void sort_naturally(std::vector<KnownFile>& files) {
    std::vector<std::string> names;
    for (const KnownFile& file : files)
        names.push_back(file.given.string());
    std::vector<KnownFile> sorted;
    for (const std::size_t file : read_names(names).order)
        sorted.push_back(std::move(files[file]));
    files = std::move(sorted);
}

/// Disks have a file that lists the others.
bool is_directory_of_dicom(const fs::path& path) {
    return lower_case(path.filename().string()).starts_with("dicomdir");
}

/// The DICOM files in a folder and in its subfolders, by their content: they have any name.
std::vector<KnownFile> dicom_files_in(const fs::path& folder) {
    constexpr std::size_t kMost = 1'000'000;
    const Format& dicom = format_named("dicom");
    std::vector<KnownFile> found;
    std::error_code ignored;
    std::size_t seen = 0;
    for (fs::recursive_directory_iterator at(folder, ignored), end; at != end;
         at.increment(ignored)) {
        if (++seen > kMost)
            throw Error(fmt::format("{}: more than {} files in it", folder.string(), kMost));
        KnownFile file{.given = at->path(), .path = at->path()};
        if (at->is_regular_file(ignored) && !is_directory_of_dicom(file.path) &&
            is_of_format(dicom, file)) {
            file.format = &dicom;
            found.push_back(std::move(file));
        }
    }
    sort_naturally(found);
    return found;
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

bool holds_values(const KnownFile& file, const ReadOptions& options) {
    if (options.dims)
        return fits_raw(file.path, options);
    // A raw file without dimensions belongs to a header beside it, or cannot be read.
    return file.format && !file.format->headerless;
}

bool is_list(const KnownFile& file) {
    return file.format && file.format->list;
}

/// All files with values, hidden ones left out; of a folder that is one volume itself alone.
std::vector<KnownFile> values_within(const fs::path& folder, const ReadOptions& options) {
    constexpr std::size_t kMost = 1'000'000;
    constexpr int kDeepest = 3;
    std::vector<KnownFile> found;
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
        const bool is_folder = at->is_directory(ignored);
        if (path.filename().string().starts_with('.')) {
            at.disable_recursion_pending();
        } else if (is_folder || at->is_regular_file(ignored)) {
            KnownFile file = known_file(path);
            if (is_folder && (file.format || at.depth() >= kDeepest))
                at.disable_recursion_pending();
            if (is_folder ? file.format != nullptr : holds_values(file, options))
                found.push_back(std::move(file));
        }
    }
    return found;
}

/// Leaves out the files that others name.
void drop_named(std::vector<KnownFile>& files) {
    std::set<std::string_view> named;
    for (const KnownFile& file : files)
        if (file.end)
            named.insert(file.end->named.begin(), file.end->named.end());
    std::erase_if(files,
                  [&](const KnownFile& file) { return file.end && named.contains(file.end->end); });
}

std::string some_of(const std::vector<std::string>& names) {
    constexpr std::size_t kShown = 6;
    const auto shown = static_cast<std::ptrdiff_t>(std::min(names.size(), kShown));
    std::string text = fmt::format("{}", fmt::join(names.begin(), names.begin() + shown, ", "));
    if (names.size() > kShown)
        text += fmt::format(" and {} more", names.size() - kShown);
    return text;
}

/// @throws Error naming the folder
FoundFiles series_in(const fs::path& folder, const ReadOptions& options) {
    std::vector<KnownFile> files = values_within(folder, options);
    if (files.empty())
        throw Error(fmt::format("{}: a folder without {}", folder.string(),
                                options.dims ? "a file as large as --dims and --type say"
                                             : "a file of values of a known format; raw values "
                                               "need --dims and --type"));
    const bool list = std::ranges::any_of(files, is_list);
    if (list)
        std::erase_if(files, [](const KnownFile& file) { return !is_list(file); });
    drop_named(files);
    sort_naturally(files);
    std::vector<std::string> names;
    for (const KnownFile& file : files)
        names.push_back(file.given.lexically_relative(folder).string());
    // Files whose names have the same pattern are a series.
    const ReadNames read = read_names(names);
    std::map<std::string, std::vector<KnownFile>> series;
    for (std::size_t i = 0; i < files.size(); ++i)
        series[read.names[i].pattern()].push_back(files[i]);
    const auto is_series = [](const auto& each) { return each.second.size() > 1; };
    if (list ? files.size() == 1 : series.size() == 1)
        return {files, std::nullopt};
    if (list || std::ranges::count_if(series, is_series) != 1) {
        std::vector<std::string> listed;
        for (const auto& [pattern, of_it] : series)
            listed.push_back(
                of_it.size() == 1
                    ? fmt::format("'{}'", of_it.front().given.string())
                    : fmt::format("'{}' ({} files)", (folder / pattern).string(), of_it.size()));
        throw Error(fmt::format("{}: a folder with several series or files, expected one: {}",
                                folder.string(), some_of(listed)));
    }
    std::vector<std::string> left;
    for (const auto& [pattern, of_it] : series)
        if (of_it.size() == 1)
            left.push_back(of_it.front().given.lexically_relative(folder).string());
    return {std::ranges::find_if(series, is_series)->second,
            fmt::format("left out of {}: {}", folder.string(), some_of(left))};
}

FoundFiles files_in(const KnownFile& folder, const ReadOptions& options) {
    if (std::vector<KnownFile> dicom = dicom_files_in(folder.given); !dicom.empty())
        return {std::move(dicom), std::nullopt};
    if (folder.format)
        return {{folder}, std::nullopt};
    return series_in(folder.given, options);
}

} // namespace

FoundFiles found_files(const std::vector<fs::path>& given, const ReadOptions& options) {
    FoundFiles all;
    std::error_code ignored;
    for (const fs::path& path : given) {
        const KnownFile file = known_file(path);
        if (!fs::is_directory(path, ignored)) {
            all.files.push_back(file);
            continue;
        }
        FoundFiles found = files_in(file, options);
        all.files.insert(all.files.end(), found.files.begin(), found.files.end());
        if (found.note)
            all.note = all.note ? *all.note + "; " + *found.note : found.note;
    }
    return all;
}

} // namespace isochron::index
