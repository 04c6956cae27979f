// Where the blocks of a regular grid lie in it.
#pragma once

#include "index/volume/grid.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace isochron::index {

/// Vertices along each axis.
using BlockSize = std::array<std::uint32_t, 3>;

struct BlockPlaces {
    Grid whole;
    std::vector<BlockSize> begins; ///< the first vertex of each block in the whole
};

/// Finds the blocks' places. Neighboring blocks may share a plane of vertices.
/// @param names of the blocks, for messages
/// @throws Error naming a block: not regular, of another spacing or direction than the first, not
///         on the same vertices, begins where another one does; or that all of them leave vertices
///         without values
BlockPlaces places_of_blocks(std::span<const Grid> blocks, std::span<const std::string> names);

/// Calls `row` with the first vertex of each row of a block, in the whole and in the block.
template <class Row>
void each_row_of_block(const BlockSize& begin, const BlockSize& size, const BlockSize& whole,
                       const Row& row) {
    std::uint64_t within = 0;
    for (std::uint32_t z = 0; z < size[2]; ++z)
        for (std::uint32_t y = 0; y < size[1]; ++y, within += size[0])
            row(begin[0] + whole[0] * (std::uint64_t{begin[1]} + y +
                                       std::uint64_t{whole[1]} * (std::uint64_t{begin[2]} + z)),
                within);
}

} // namespace isochron::index
