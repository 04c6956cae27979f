// The files that a file names, by paths that begin in its folder.
#pragma once

#include <filesystem>
#include <string>

namespace isochron::index {

/// A path that stands in a file, with slashes: programs on Windows write `data\t_0.raw`. Where there is
/// a file whose name has a backslash, it is meant.
std::string path_named_in(const std::filesystem::path& file, std::string path);

/// The file at such a path.
std::filesystem::path file_named_in(const std::filesystem::path& file, const std::string& path);

} // namespace isochron::index
