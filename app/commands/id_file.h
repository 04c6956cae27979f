// Files of cell ids: u32, little-endian, no header.
#pragma once

#include "index/volume/grid.h"

#include <filesystem>
#include <vector>

namespace isochron::app {

/// @throws index::Error when it cannot be written; then no file is left
void write_ids(const std::filesystem::path& path, const std::vector<index::CellId>& ids);

} // namespace isochron::app
