// What a search has to look at, whatever it does: the blocks that hold active cells, and the cache
// lines in which their values lie.
#pragma once

#include "index/volume/grid.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace isochron::bench {

/// The blocks of one size.
struct TouchedBlocks {
    std::size_t blocks = 0;  ///< blocks of the grid
    std::size_t held = 0;    ///< that hold an active cell; exact extremes leave no others
    std::uint64_t bytes = 0; ///< cache lines with a vertex of these, borders included
};

/// @param ids all active cells @param edges cells of a block along x, y, z
/// @param value_bytes of a stored value; values lie row after row, from the start of a cache line
TouchedBlocks touched_blocks(const std::vector<index::CellId>& ids, const index::Grid& grid,
                             const std::array<std::uint32_t, 3>& edges, std::size_t value_bytes);

} // namespace isochron::bench
