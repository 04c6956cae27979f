// Which neighboring chunks the cells of a chunk need, by where in the chunk the cells lie.
#pragma once

#include "index/file/chunks/chunk_grid.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace isochron::index {

/// A set of the chunks at offsets dx, dy, dz of -1 to 1: bit (dz + 1) * 9 + (dy + 1) * 3 + dx + 1.
using ChunksAround = std::uint32_t;
constexpr unsigned kChunksAround = 27, kOwnChunk = 13;

/// Where a cell lies in its chunk along an axis, told by what it needs beyond the chunk: nothing;
/// for its normal the vertex below, or the second vertex above; or its own upper vertex.
enum Side : unsigned { nothing, vertex_below, two_vertices_on, next_vertex };
constexpr unsigned kSides = 4;

/// The side of each cell by its place in the chunk.
constexpr std::array<std::uint8_t, kChunkEdge> kSide = [] {
    std::array<std::uint8_t, kChunkEdge> side{};
    side[0] = vertex_below;
    side[kChunkEdge - 2] = two_vertices_on;
    side[kChunkEdge - 1] = next_vertex;
    return side;
}();

/// A set of combinations of sides: bit x + kSides * (y + kSides * z).
using SidesOfCells = std::uint64_t;
static_assert(kSides * kSides * kSides == 64);

/// For each combination of sides: the chunks that hold the vertices of such a cell and, for
/// normals, the neighbors of these vertices along each axis.
using ReachOfSides = std::array<ChunksAround, 64>;
constexpr ReachOfSides reach_of_sides(bool normals) {
    ReachOfSides reach{};
    for (unsigned i = 0; i < reach.size(); ++i) {
        const std::array<unsigned, 3> side{i % kSides, i / kSides % kSides, i / kSides / kSides};
        for (int bit = 0; bit < int{kChunksAround}; ++bit) {
            const std::array<int, 3> d{bit % 3 - 1, bit / 3 % 3 - 1, bit / 9 - 1};
            unsigned beyond = 0; // axes along which a neighbor needs it, but not the cell
            bool reached = true;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const bool own = d[axis] == 0 || (d[axis] == 1 && side[axis] == next_vertex);
                beyond += own ? 0 : 1;
                reached = reached && (own || (d[axis] == 1 && side[axis] == two_vertices_on) ||
                                      (d[axis] == -1 && side[axis] == vertex_below));
            }
            if (reached && beyond <= (normals ? 1u : 0u))
                reach[i] |= 1u << bit;
        }
    }
    return reach;
}
inline constexpr ReachOfSides kReach = reach_of_sides(false),
                              kReachWithNormals = reach_of_sides(true);

/// For each neighboring chunk (a bit of ChunksAround): the combinations of sides whose cells need
/// it.
using SidesNeeding = std::array<SidesOfCells, kChunksAround>;
constexpr SidesNeeding sides_needing(const ReachOfSides& reach) {
    SidesNeeding sides{};
    for (unsigned bit = 0; bit < kChunksAround; ++bit)
        for (unsigned i = 0; i < reach.size(); ++i)
            sides[bit] |= SidesOfCells{reach[i] >> bit & 1} << i;
    return sides;
}
inline constexpr SidesNeeding kSidesNeeding = sides_needing(kReach),
                              kSidesNeedingWithNormals = sides_needing(kReachWithNormals);

/// The combination of sides of a cell by its coordinates, as a bit of SidesOfCells.
inline unsigned side_of_cell(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return kSide[x % kChunkEdge] +
           kSides * (kSide[y % kChunkEdge] + kSides * unsigned{kSide[z % kChunkEdge]});
}

/// Joins the chunks of all bits that are set.
template <class Bits, std::size_t kBits>
ChunksAround joined(Bits bits, const std::array<ChunksAround, kBits>& of_bit) {
    ChunksAround around = 0;
    for (; bits; bits &= bits - 1)
        around |= of_bit[static_cast<std::size_t>(std::countr_zero(bits))];
    return around;
}

inline ChunksAround chunks_around(SidesOfCells sides, bool normals) {
    return joined(sides, normals ? kReachWithNormals : kReach);
}

/// Calls `f(bit, x, y, layer)` for each of the chunks around the chunk at (x, y, layer) that the
/// grid has.
template <class F>
void for_each_around(ChunksAround around, const std::array<std::uint32_t, 3>& at,
                     const ChunkGrid& grid, const F& f) {
    const auto& n = grid.counts();
    for (; around; around &= around - 1) {
        const auto bit = static_cast<std::uint32_t>(std::countr_zero(around));
        // Coordinates plus 1; chunks outside the grid do not exist.
        const std::array<std::uint32_t, 3> to{at[0] + bit % 3, at[1] + bit / 3 % 3,
                                              at[2] + bit / 9};
        if (to[0] > 0 && to[0] <= n[0] && to[1] > 0 && to[1] <= n[1] && to[2] > 0 && to[2] <= n[2])
            f(bit, to[0] - 1, to[1] - 1, to[2] - 1);
    }
}

} // namespace isochron::index
