// The planes of the cells of one chunk.
#pragma once

#include "index/search/cube_cells.h"
#include "index/volume/query.h"

#include <cstdint>
#include <span>

namespace isochron::index {

/// Makes packed planes (cell_plane.h), the same as `shade_cells` makes in the whole step.
/// @param cube with all vertices around the cells @param planes one for each cell
void shade_cube(const ChunkCube& cube, const Query& query, std::span<const PlaceInChunk> cells,
                std::span<std::uint32_t> planes);

} // namespace isochron::index
