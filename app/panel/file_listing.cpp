// What the window for choosing data lists: folders, series of files, and files.
#include "app/panel/file_listing.h"

#include "app/config/series_names.h"
#include "app/text.h"
#include "index/lower_case.h"
#include "index/readers/formats/format.h"
#include "index/readers/formats/model_file.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include <sys/stat.h>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using Kind = ListedFile::Kind;

constexpr std::size_t kMostListed = 5000;

/// Whether a file, or a folder that is one volume, is one that the program reads, by its name.
bool is_readable(const std::string& name, bool folder) {
    return index::has_known_end(name, folder) ||
           (!folder && (index::lower_case(name).ends_with(".isochron") ||
                        index::is_model_name(name)));
}

ListedFile line_of(const fs::path& path, std::string name) {
    ListedFile line{.kind = Kind::file, .name = std::move(name), .path = path, .bytes = {}};
    struct stat facts {};
    if (stat(path.c_str(), &facts) != 0)
        return line;
    line.changed = facts.st_mtime;
    if (S_ISDIR(facts.st_mode))
        line.kind = Kind::folder;
    else
        line.bytes = static_cast<std::uintmax_t>(facts.st_size);
    return line;
}

} // namespace

Listing listed_in(const fs::path& folder, bool all) {
    Listing listing;
    std::vector<std::string> data;
    std::error_code error;
    fs::directory_iterator entry(folder, fs::directory_options::skip_permission_denied, error);
    for (; !error && entry != fs::directory_iterator() && listing.lines.size() < kMostListed;
         entry.increment(error)) {
        std::error_code ignored;
        const std::string name = entry->path().filename().string();
        if (name.starts_with('.'))
            continue;
        const bool holds = entry->is_directory(ignored);
        const bool readable = is_readable(name, holds);
        if (!holds && !(entry->is_regular_file(ignored) && (readable || all)))
            continue;
        ListedFile line = line_of(entry->path(), name);
        if (holds && readable)
            line.kind = Kind::file; // it is one volume
        if (readable && line.kind == Kind::file && !name.ends_with(".isochron"))
            data.push_back(name);
        listing.lines.push_back(std::move(line));
    }
    if (error)
        listing.complaint = error.message();
    std::ranges::sort(data);
    for (const NamedSeries& each : series_among(data)) {
        ListedFile line =
            line_of(folder / each.last, fmt::format("{} to {}", each.first, each.last));
        line.kind = Kind::series;
        line.path = pattern_in(folder, each.pattern);
        line.bytes.reset();
        line.files = each.files;
        listing.lines.push_back(std::move(line));
    }
    return listing;
}

Listing listed(std::span<const fs::path> paths) {
    Listing listing;
    for (const fs::path& path : paths) {
        ListedFile line = line_of(path, path.string());
        line.kind = is_pattern(path.filename().string()) ? Kind::series : Kind::file;
        listing.lines.push_back(std::move(line));
    }
    return listing;
}

void sort_lines(std::vector<ListedFile>& lines, ListOrder by, bool descending) {
    const auto name_of = [](const ListedFile& line) { return std::tie(line.kind, line.name); };
    std::ranges::sort(lines, {}, name_of);
    const auto before = [&](const ListedFile& a, const ListedFile& b) {
        const ListedFile &one = descending ? b : a, &other = descending ? a : b;
        if ((a.kind == Kind::folder) != (b.kind == Kind::folder))
            return a.kind == Kind::folder;
        switch (by) {
        case ListOrder::size: return one.bytes.value_or(0) < other.bytes.value_or(0);
        case ListOrder::date: return one.changed < other.changed;
        case ListOrder::name: break;
        }
        return std::tie(a.kind, one.name) < std::tie(b.kind, other.name);
    };
    std::ranges::stable_sort(lines, before);
}

std::string size_words(const ListedFile& line) {
    if (line.kind == Kind::series)
        return line.files > 0 ? fmt::format("{} files", line.files) : std::string("series");
    return line.bytes && line.kind == Kind::file ? human_bytes(static_cast<double>(*line.bytes))
                                                 : std::string();
}

std::string date_words(const ListedFile& line) {
    std::tm parts{};
    if (line.changed == 0 || localtime_r(&line.changed, &parts) == nullptr)
        return {};
    return fmt::format("{:%Y-%m-%d %H:%M}", parts);
}

} // namespace isochron::app
