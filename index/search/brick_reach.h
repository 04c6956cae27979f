// The bricks of a chunk that may hold active cells, and the chunks around it that these need.
#pragma once

#include "index/search/chunk_reach.h"
#include "index/volume/level_map.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace isochron::index {

/// A set of bricks of a chunk: bit i is brick i in the order of `ChunkBricks`.
using BricksOfChunk = std::uint32_t;
static_assert(kBricksOfChunk == 32);

/// The bricks that may hold active cells.
inline BricksOfChunk bricks_of(const ChunkBricks& bricks, const LevelMap::Cut& cut) {
    BricksOfChunk bits = 0;
    for (std::uint32_t i = 0; i < kBricksOfChunk; ++i)
        bits |= (cut.may_hold(bricks[i], bricks[kBricksOfChunk + i]) ? 1u : 0u) << i;
    return bits;
}

using ChunksOfBricks = std::array<ChunksAround, kBricksOfChunk>;

/// By brick of a chunk: the chunks that hold vertices of its cells, and, for normals, the neighbors
/// of these along each axis.
constexpr ChunksOfBricks chunks_of_bricks(bool normals) {
    ChunksOfBricks around{};
    for (std::uint32_t i = 0; i < kBricksOfChunk; ++i) {
        const std::array<std::uint32_t, 3> at{i % kChunkBricks[0],
                                              i / kChunkBricks[0] % kChunkBricks[1],
                                              i / kChunkBricks[0] / kChunkBricks[1]};
        for (int bit = 0; bit < int{kChunksAround}; ++bit) {
            const std::array<int, 3> d{bit % 3 - 1, bit / 3 % 3 - 1, bit / 9 - 1};
            int below = 0; // axes along which only a neighbor's normal needs it
            bool reached = true;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                below += d[axis] < 0 ? 1 : 0;
                reached = reached && (d[axis] == 0 || (d[axis] < 0 && at[axis] == 0) ||
                                      (d[axis] > 0 && at[axis] + 1 == kChunkBricks[axis]));
            }
            if (reached && below <= (normals ? 1 : 0))
                around[i] |= 1u << bit;
        }
    }
    return around;
}
inline constexpr ChunksOfBricks kChunksOfBrick = chunks_of_bricks(false),
                                kChunksOfBrickWithNormals = chunks_of_bricks(true);

} // namespace isochron::index
