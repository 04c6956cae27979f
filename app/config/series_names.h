// Names of files that belong together: the steps of a series.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::app {

/// Files whose names differ in one number.
struct NamedSeries {
    std::string pattern; ///< matches these and no other file of the folder: `t[0-9]*.vti`
    std::string first, last;
    std::size_t files = 0; ///< at least 2
};

/// The series among the names of a folder, in the order of their first names.
std::vector<NamedSeries> series_among(std::span<const std::string> names);

/// The message about files for which `one_name_of` finds no name.
inline constexpr const char* kNoCommonName =
    "no pattern matches these files and no others: open one, or all of a folder";

/// One name that stands for all the files: the name of a single file, or a pattern that matches
/// these and no other file of their folder; empty if there is none.
std::optional<std::filesystem::path> one_name_of(std::span<const std::filesystem::path> files);

/// A pattern of file names with the folder in front, in which `*` and the like are escaped.
std::filesystem::path pattern_in(const std::filesystem::path& folder, const std::string& pattern);

/// Whether a name is a pattern that may stand for several files.
bool is_pattern(const std::string& name);

/// The name of data as people read it, without the folder: `t*.vti` for the pattern `t[0-9]*.vti`.
std::string said_name(const std::filesystem::path& data);

} // namespace isochron::app
