// The grid of chunks into which the vertices of a step are cut in the file.
#pragma once

#include "index/scan/bricks.h"
#include "index/volume/grid.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace isochron::index {

/// Vertices along each side of a chunk; chunks at the upper borders are clipped.
constexpr std::uint32_t kChunkEdge = 16;

/// Number of bricks of a chunk along x, y and z (stored x fastest). They hold the cells whose
/// lowest vertex is in the chunk.
constexpr std::array<std::uint32_t, 3> kChunkBricks{kChunkEdge / BrickGrid::kCells[0],
                                                    kChunkEdge / BrickGrid::kCells[1],
                                                    kChunkEdge / BrickGrid::kCells[2]};
constexpr std::size_t kBricksOfChunk =
    std::size_t{kChunkBricks[0]} * kChunkBricks[1] * kChunkBricks[2];

/// Index of brick i of a chunk among all bricks of the grid, in the order of `build_bricks`;
/// nothing if the grid has no such brick. @param at chunk coordinates x, y and z
inline std::optional<std::size_t>
brick_of_chunk(const BrickGrid& grid, const std::array<std::uint32_t, 3>& at, std::uint32_t i) {
    const auto& n = grid.bricks();
    const std::uint32_t x = at[0] * kChunkBricks[0] + i % kChunkBricks[0];
    const std::uint32_t y = at[1] * kChunkBricks[1] + i / kChunkBricks[0] % kChunkBricks[1];
    const std::uint32_t z = at[2] * kChunkBricks[2] + i / kChunkBricks[0] / kChunkBricks[1];
    if (x >= n[0] || y >= n[1] || z >= n[2])
        return {};
    return (std::size_t{z} * n[1] + y) * n[0] + x;
}

/// The lowest rank of each of a chunk's bricks, then the highest of each; 255 and 0 where the grid
/// has no brick.
using ChunkBricks = std::array<std::uint8_t, 2 * kBricksOfChunk>;

/// Chunks are stored layer after layer along z, and in Morton order of x and y within a layer, so
/// that chunks that are near in space are mostly near in the file. A chunk is identified by its
/// layer and its place in that order.
class ChunkGrid {
  public:
    explicit ChunkGrid(const Grid& grid);

    std::uint32_t layers() const { return counts_[2]; }
    std::uint32_t chunks_of_layer() const { return counts_[0] * counts_[1]; }
    std::uint64_t count() const { return std::uint64_t{layers()} * chunks_of_layer(); }
    /// Chunks along x, y and z.
    const std::array<std::uint32_t, 3>& counts() const { return counts_; }

    std::uint32_t place(std::uint32_t x, std::uint32_t y) const {
        return place_[std::size_t{y} * counts_[0] + x];
    }
    /// Chunk coordinates x and y.
    std::array<std::uint32_t, 2> at(std::uint32_t place) const {
        return {at_[place] % counts_[0], at_[place] / counts_[0]};
    }
    /// Vertices along x, y and z.
    std::array<std::uint32_t, 3> size(std::uint32_t layer, std::uint32_t place) const {
        const auto [x, y] = at(place);
        return {extent(0, x), extent(1, y), extent(2, layer)};
    }

  private:
    std::uint32_t extent(std::size_t axis, std::uint32_t chunk) const {
        return std::min(kChunkEdge, vertices_[axis] - chunk * kChunkEdge);
    }

    std::array<std::uint32_t, 3> vertices_, counts_;
    std::vector<std::uint32_t> place_, at_; ///< place by y and x; y * counts_[0] + x by place
};

} // namespace isochron::index
