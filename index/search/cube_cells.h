// The active cells of one chunk, found in its cube: as bits, and as places in the chunk.
#pragma once

#include "index/search/chunk_cube.h"
#include "index/search/layer_candidates.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

namespace isochron::index {

/// The active cells of a chunk: for each row of cells (z * kChunkEdge + y) a bit for each x.
using CubeRows = std::array<std::uint16_t, std::size_t{kChunkEdge} * kChunkEdge>;
/// The place of a cell in its chunk: x + kChunkEdge * (y + kChunkEdge * z).
using PlaceInChunk = std::uint16_t;

/// Finds the active cells of a cube's chunk.
/// @param cut ordinal of a stored value, see stored_cut
/// @param bricks only cells of these
CubeRows active_rows(const ChunkCube& cube, std::uint64_t cut, BricksOfChunk bricks);
/// The combinations of sides that these cells have (chunk_reach.h), which say what chunks they
/// need.
SidesOfCells sides_of(const CubeRows& rows);
/// Leaves only the cells with these combinations of sides.
void keep_sides(SidesOfCells sides, CubeRows& rows);
/// Appends the places of these cells, ascending. @return their number
std::size_t append_places(const CubeRows& rows, std::vector<PlaceInChunk>& places);
/// Number of cells in each row, in the order of CubeRows.
using RowCounts = std::array<std::uint32_t, std::tuple_size_v<CubeRows>>;
/// Adds the number of active cells of each row.
void add_counts(const CubeRows& rows, RowCounts& counts);
/// Number of cells in these bricks of a chunk. @param cells of the chunk along each axis
std::uint64_t cells_of_bricks(BricksOfChunk bricks, const std::array<std::uint32_t, 3>& cells);

} // namespace isochron::index
