// What the window for choosing data lists: folders, series of files, and files.
#pragma once

#include <cstdint>
#include <ctime>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::app {

struct ListedFile {
    enum class Kind : std::uint8_t { folder, series, file };
    Kind kind = Kind::file;
    std::string name;           ///< as it is listed
    std::filesystem::path path; ///< what it stands for; the pattern of a series
    std::optional<std::uintmax_t> bytes;
    std::size_t files = 0;   ///< number of files in a series
    std::time_t changed = 0; ///< 0: unknown
};

enum class ListOrder : std::uint8_t { name, size, date };

struct Listing {
    std::vector<ListedFile> lines;
    std::string complaint; ///< why the folder cannot be listed
};

/// The folder's contents whose names do not begin with a dot; at most 5,000.
/// @param all files of which the program reads no name, too
Listing listed_in(const std::filesystem::path& folder, bool all);
/// These, as they are named.
Listing listed(std::span<const std::filesystem::path> paths);

/// Folders first, then by one of their columns. Equal ones keep the order of their names.
void sort_lines(std::vector<ListedFile>& lines, ListOrder by, bool descending);

/// `1.20 MiB`, `12 files`; empty for folders.
std::string size_words(const ListedFile& line);
/// `2026-11-28 00:45`, in local time; empty if it is not known.
std::string date_words(const ListedFile& line);

} // namespace isochron::app
