// Tiles: the vertices of every brick side by side in memory, as ranks of 8 bits. For a step that is
// searched again and again.
// In the rows of a step the vertices of a brick of floats lie in 38 cache lines, in its tile in 4.
// Ranks are the brick's own: monotone, so that only a vertex whose rank is the isovalue's has to be
// looked up among the values. The result is exact.
#pragma once

#include "index/volume/level_map.h"
#include "index/volume/query.h"
#include "index/volume/step_values.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

namespace isochron::index {

constexpr std::size_t kTileBytes = 256; ///< four cache lines

/// Bytes of the tiles of a step.
std::size_t tile_bytes(const Grid& grid);

/// Fills the tiles of a step. @param out `tile_bytes(values.grid)` bytes, aligned to 64
/// @return false, with some tiles missing, when stopped
bool build_tiles(const StepValues& values, std::size_t step, std::span<std::uint8_t> out,
                 unsigned threads, const std::stop_token& stop = {});

/// Appends the same cells as `test_bricks`, in any order.
/// @param bricks of the query's step, with these levels @param tiles of that step
/// @return number of cells that were tested
std::uint64_t test_tiles(const StepValues& values, const LevelMap& levels,
                         std::span<const std::uint8_t> bricks, std::span<const std::uint8_t> tiles,
                         const Query& query, std::vector<CellId>& out);

} // namespace isochron::index
