// Files of cell ids: little-endian, no header.
#pragma once

#include "index/surface/cell_set.h"
#include "index/volume/grid.h"

#include <filesystem>
#include <vector>

namespace isochron::app {

/// Writes the ids as u32.
/// @throws index::Error when the file cannot be written; then no file is left
void write_ids(const std::filesystem::path& path, const std::vector<index::CellId>& ids);

/// Writes the ids as u32, or as u64 if the grid has too many cells for u32 ids; then they are made
/// from `set.points`, which must be filled.
/// @throws index::Error as above
void write_ids(const std::filesystem::path& path, const index::CellSet& set,
               const index::Grid& grid);

} // namespace isochron::app
