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
    std::string pattern; ///< that only they match in their folder: `t[0-9]*.vti`
    std::string first, last;
    std::size_t files = 0; ///< at least 2
};

/// The series among the names of a folder, in the order of their first names.
std::vector<NamedSeries> series_among(std::span<const std::string> names);

/// Said of files for which `one_name_of` has none.
inline constexpr const char* kNoCommonName =
    "these files have no name in common that only they have: open one, or all of a folder";

/// One name that stands for the files: that of a single one, or the pattern that, in their folder,
/// only they match; nothing if there is none.
std::optional<std::filesystem::path> one_name_of(std::span<const std::filesystem::path> files);

/// A pattern of names as one that stands for the files of this folder.
std::filesystem::path pattern_in(const std::filesystem::path& folder, const std::string& pattern);

/// Whether a name is a pattern that may stand for several files.
bool is_pattern(const std::string& name);

} // namespace isochron::app
