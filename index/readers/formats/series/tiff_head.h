// What the first page of a TIFF file tells before a reader opens it.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace isochron::index {

/// Whether a file, of either byte order and size, has one page alone. @return none: it cannot be told
std::optional<bool> is_flat_tiff(const std::filesystem::path& path);

/// The given files, but not those whose pages another of them names: each file of an OME-TIFF data
/// set may name the pages of all its files.
std::vector<std::filesystem::path>
not_named_by_others(const std::vector<std::filesystem::path>& files);

} // namespace isochron::index
