// Files of cell ids: little-endian, no header.
#pragma once

#include "index/extraction/cell_set.h"
#include "index/volume/grid.h"

#include <filesystem>
#include <vector>

namespace isochron::app {

/// u32.
/// @throws index::Error when it cannot be written; then no file is left
void write_ids(const std::filesystem::path& path, const std::vector<index::CellId>& ids);

/// u32, or u64 where the grid has cells whose number does not fit: of these the set must have its
/// points.
/// @throws index::Error as above
void write_ids(const std::filesystem::path& path, const index::CellSet& set,
               const index::Grid& grid);

} // namespace isochron::app
