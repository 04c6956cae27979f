// The active cells of one chunk, from its cube: as bits, and as places in the chunk.
#pragma once

#include "index/search/chunk_cube.h"
#include "index/search/layer_candidates.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

namespace isochron::index {

/// By row of a chunk's cells (z * kChunkEdge + y): bit x for each active cell.
using CubeRows = std::array<std::uint16_t, std::size_t{kChunkEdge} * kChunkEdge>;
/// The place of a cell in its chunk: x + kChunkEdge * (y + kChunkEdge * z).
using PlaceInChunk = std::uint16_t;

/// Finds the active cells of the chunk of a cube.
/// @param cut ordinal of a stored value, see stored_cut
/// @param bricks only cells of these
CubeRows active_rows(const ChunkCube& cube, std::uint64_t cut, BricksOfChunk bricks);
/// Where these cells lie, for what they need around them.
SidesOfCells sides_of(const CubeRows& rows);
/// Leaves only the cells that lie there.
void keep_sides(SidesOfCells sides, CubeRows& rows);
/// Appends the places of these cells, ascending. @return their number
std::size_t append_places(const CubeRows& rows, std::vector<PlaceInChunk>& places);
/// By row, as above: a number of cells.
using RowCounts = std::array<std::uint32_t, std::tuple_size_v<CubeRows>>;
/// Adds the numbers of active cells.
void add_counts(const CubeRows& rows, RowCounts& counts);
/// How many cells these bricks of a chunk have. @param cells of the chunk along each axis
std::uint64_t cells_of_bricks(BricksOfChunk bricks, const std::array<std::uint32_t, 3>& cells);

} // namespace isochron::index
