// Finds the files of folders, and sorts them into series.
#include "index/readers/formats/series/folder_files.h"

#include "index/error.h"
#include "index/lower_case.h"
#include "index/readers/formats/foreign_names.h"
#include "index/readers/formats/series/numbered_name.h"

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
            throw Error("{}: more than {} files in it", folder.string(), kMost);
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

/// All files with values, without hidden ones. A folder that is one volume stands for itself.
std::vector<KnownFile> values_within(const fs::path& folder, const ReadOptions& options) {
    constexpr std::size_t kMost = 1'000'000;
    constexpr int kDeepest = 3;
    std::vector<KnownFile> found;
    std::error_code error;
    std::size_t seen = 0;
    fs::recursive_directory_iterator at(folder, error);
    if (error)
        throw Error("{}: the folder cannot be read: {}", folder.string(), error.message());
    for (const fs::recursive_directory_iterator end; !error && at != end; at.increment(error)) {
        const fs::path& path = at->path();
        if (++seen > kMost)
            throw Error("{}: more than {} files in it", folder.string(), kMost);
        std::error_code ignored;
        const bool is_folder = at->is_directory(ignored);
        if (path.filename().string().starts_with('.')) {
            at.disable_recursion_pending();
        } else if (is_folder || at->is_regular_file(ignored)) {
            KnownFile file = known_file(path, is_folder);
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

using SeriesByPattern = std::map<std::string, std::vector<KnownFile>>;

/// Files whose names have the same pattern are a series.
SeriesByPattern series_among(const std::vector<KnownFile>& files, const fs::path& folder) {
    std::vector<std::string> names;
    for (const KnownFile& file : files)
        names.push_back(file.given.lexically_relative(folder).string());
    const ReadNames read = read_names(names);
    SeriesByPattern series;
    for (std::size_t i = 0; i < files.size(); ++i)
        series[read.names[i].pattern()].push_back(files[i]);
    return series;
}

bool is_series(const SeriesByPattern::value_type& each) {
    return each.second.size() > 1;
}

/// Lists of files in a folder, and what else is there.
struct Lists {
    std::vector<KnownFile> usable;  ///< all that they name is there
    std::vector<std::string> stale; ///< why others are not
    std::vector<KnownFile> unnamed; ///< files that no usable one names
    std::set<std::string> patterns; ///< patterns of the files that usable files name
};

Lists lists_among(const std::vector<KnownFile>& files, const fs::path& folder) {
    Lists lists;
    std::set<fs::path> named;
    for (const KnownFile& file : files) {
        if (!is_list(file))
            continue;
        const std::string name = file.given.lexically_relative(folder).string();
        try {
            const ListedFiles listed = file.format->list(file.path);
            const auto missing = std::ranges::find_if(
                listed, [](const ListedFile& each) { return !fs::exists(each.path); });
            if (missing != listed.end()) {
                lists.stale.push_back(fmt::format("{}, since {} is not there", name,
                                                  missing->path.filename().string()));
                continue;
            }
            for (const ListedFile& each : listed)
                named.insert(fs::weakly_canonical(each.path));
            lists.usable.push_back(file);
        } catch (const Error&) { // it says why when it is given itself
            lists.stale.push_back(name + ", since it cannot be read");
        }
    }
    const SeriesByPattern all = series_among(files, folder);
    for (const auto& [pattern, of_it] : all)
        for (const KnownFile& file : of_it) {
            if (is_list(file))
                continue;
            if (named.contains(fs::weakly_canonical(file.given)))
                lists.patterns.insert(pattern);
            else
                lists.unnamed.push_back(file);
        }
    return lists;
}

[[noreturn]] void fail_with_several(const fs::path& folder, const SeriesByPattern& series) {
    std::vector<std::string> listed;
    for (const auto& [pattern, of_it] : series)
        listed.push_back(
            of_it.size() == 1
                ? fmt::format("'{}'", of_it.front().given.string())
                : fmt::format("'{}' ({} files)", (folder / pattern).string(), of_it.size()));
    throw Error("{}: a folder with several series or files, expected one: {}", folder.string(),
                some_of(listed));
}

/// The list that a folder has, unless it holds another series beside what that names.
/// @return none where there is no list that can be used
std::optional<FoundFiles> list_in(const fs::path& folder, const Lists& lists) {
    if (lists.usable.empty())
        return std::nullopt;
    SeriesByPattern others = series_among(lists.unnamed, folder);
    const auto is_other = [&](const SeriesByPattern::value_type& each) {
        return is_series(each) && !lists.patterns.contains(each.first);
    };
    if (lists.usable.size() > 1 || std::ranges::any_of(others, is_other)) {
        std::erase_if(others, [&](const auto& each) { return !is_other(each); });
        for (const KnownFile& list : lists.usable)
            others[list.given.lexically_relative(folder).string()] = {list};
        fail_with_several(folder, others);
    }
    std::vector<std::string> left = lists.stale;
    for (const KnownFile& file : lists.unnamed)
        left.push_back(file.given.lexically_relative(folder).string());
    return FoundFiles{lists.usable,
                      left.empty()
                          ? std::nullopt
                          : std::optional(fmt::format(
                                "left out of {}, as {} does not name them: {}", folder.string(),
                                lists.usable.front().given.filename().string(), some_of(left)))};
}

/// @throws Error naming a file in the folder of a format that is known and not read
void expect_no_foreign(const fs::path& folder) {
    constexpr int kMost = 100;
    int seen = 0;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
        FileStart start(entry.path());
        const bool may_be_values = entry.path().extension() != ".isochron"; // an index beside them
        if (may_be_values && entry.is_regular_file(ignored))
            if (const std::string foreign = foreign_format_or_name(start); !foreign.empty())
                throw Error("{}: {}", entry.path().string(), foreign);
        if (++seen > kMost)
            return;
    }
}

/// @throws Error naming the folder
FoundFiles series_in(const fs::path& folder, const ReadOptions& options) {
    std::vector<KnownFile> files = values_within(folder, options);
    if (files.empty() && !options.dims)
        expect_no_foreign(folder);
    if (files.empty())
        throw Error("{}: a folder without {}", folder.string(),
                    options.dims ? "a file as large as --dims and --type say"
                                 : "a file of values of a known format; raw values "
                                   "need --dims and --type");
    drop_named(files);
    sort_naturally(files);
    std::vector<std::string> left;
    if (std::ranges::any_of(files, is_list)) {
        const Lists lists = lists_among(files, folder);
        if (auto found = list_in(folder, lists))
            return std::move(*found);
        if (std::ranges::all_of(files, is_list))
            return {files, std::nullopt};
        left = lists.stale;
        std::erase_if(files, is_list);
    }
    const SeriesByPattern series = series_among(files, folder);
    if (series.size() > 1 && std::ranges::count_if(series, is_series) != 1)
        fail_with_several(folder, series);
    if (series.size() > 1)
        for (const auto& each : series)
            if (!is_series(each))
                left.push_back(each.second.front().given.lexically_relative(folder).string());
    const auto found =
        series.size() == 1 ? series.begin() : std::ranges::find_if(series, is_series);
    return {found->second,
            left.empty()
                ? std::nullopt
                : std::optional(fmt::format("left out of {}: {}", folder.string(), some_of(left)))};
}

/// Drops each of the given files that another one names, as a list or a header does.
void drop_what_others_name(std::vector<KnownFile>& files, const ReadOptions& options) {
    if (files.size() < 2 || options.dims)
        return;
    drop_named(files);
    const bool described = std::ranges::any_of(files, [](const KnownFile& file) {
        return file.format && !file.format->headerless && !is_list(file);
    });
    if (described)
        std::erase_if(files,
                      [](const KnownFile& file) { return file.format && file.format->headerless; });
    const auto lists = std::ranges::count_if(files, is_list);
    if (lists != 1)
        return;
    const KnownFile list = *std::ranges::find_if(files, is_list);
    std::set<fs::path> named;
    for (const ListedFile& each : list.format->list(list.path))
        named.insert(fs::weakly_canonical(each.path));
    if (std::ranges::all_of(files, [&](const KnownFile& file) {
            return is_list(file) || named.contains(fs::weakly_canonical(file.given));
        }))
        files = {list};
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
    for (const fs::path& path : given) {
        const KnownFile file = known_file(path);
        if (!file.is_folder) {
            all.files.push_back(file);
            continue;
        }
        FoundFiles found = files_in(file, options);
        all.files.insert(all.files.end(), found.files.begin(), found.files.end());
        if (found.note)
            all.note = all.note ? *all.note + "; " + *found.note : found.note;
    }
    drop_what_others_name(all.files, options);
    return all;
}

} // namespace isochron::index
