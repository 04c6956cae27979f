// Paths as they are on the disk.
#pragma once

#include <filesystem>

namespace isochron::index {

/// The absolute path without symbolic links, `.` and `..`: as far as its parts are there, the rest as it
/// is written.
std::filesystem::path whole_path(const std::filesystem::path& path);

/// Whether a file, or what will be one, is in a folder or below, or is the folder. Both are whole paths.
bool lies_within(const std::filesystem::path& file, const std::filesystem::path& folder);

} // namespace isochron::index
