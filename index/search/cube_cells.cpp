// Compares the vertices of a cube with the isovalue, and combines the vertices' bits into cells'
// bits.
#include "index/search/cube_cells.h"
#include "index/volume/ordinal.h"

#include <algorithm>
#include <bit>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "index/search/cube_cells.cpp"
#include <hwy/foreach_target.h> // must come before highway.h

#include "index/scan/vertex_bits_inl.h"

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {
namespace {

constexpr std::size_t kAcross = 32; ///< vertices along y with padding; the first 17 are used
/// Bits of vertices, by z and y.
using Plane = std::array<std::uint32_t, kAcross>;
using Planes = std::array<Plane, kChunkEdge + 1>;

template <class T>
void find_rows(const ChunkCube& cube, T cut, CubeRows& rows) {
    const StepValues& values = cube.values();
    const auto& [nx, ny, nz] = cube.cells();
    const std::size_t row = values.grid.vertices[0], plane = row * values.grid.vertices[1];
    const auto* const begin = reinterpret_cast<const T*>(values.first);
    const VertexComparer<T> comparer(begin + values.stride / sizeof(T), cut);
    const auto& at = cube.first();
    const T* const first = begin + at[2] * plane + at[1] * row + at[0];
    Planes upper{};
    bool nan = false;
    for (std::uint32_t z = 0; z <= nz; ++z)
        for (std::uint32_t y = 0; y <= ny; ++y) {
            const VertexBits bits = comparer.compare(first + z * plane + y * row, nx + 1);
            upper[z][y] = static_cast<std::uint32_t>(bits.upper);
            nan |= bits.nan;
        }
    const std::uint32_t cells = (1u << nx) - 1;
    const auto combine = [&](const Planes& bits, const auto& of_cell) HWY_ATTR {
        for (std::uint32_t z = 0; z < nz; ++z)
            for (std::uint32_t y = 0; y < kChunkEdge; ++y) {
                const std::uint32_t a = bits[z][y], b = bits[z][y + 1], c = bits[z + 1][y],
                                    d = bits[z + 1][y + 1];
                const std::uint32_t any = a | b | c | d, all = a & b & c & d;
                of_cell(rows[z * kChunkEdge + y], any | any >> 1, all & all >> 1);
            }
    };
    combine(upper, [&](std::uint16_t& out, std::uint32_t any, std::uint32_t all)
                       HWY_ATTR { out = static_cast<std::uint16_t>(any & ~all & cells); });
    if (HWY_UNLIKELY(nan)) {
        Planes of_nan{};
        for (std::uint32_t z = 0; z <= nz; ++z)
            for (std::uint32_t y = 0; y <= ny; ++y)
                of_nan[z][y] =
                    static_cast<std::uint32_t>(comparer.nan(first + z * plane + y * row, nx + 1));
        combine(of_nan, [](std::uint16_t& out, std::uint32_t any, std::uint32_t)
                            HWY_ATTR { out = static_cast<std::uint16_t>(out & ~any); });
    }
}

void find_active_rows(const ChunkCube& cube, std::uint64_t cut, CubeRows& rows) {
    visit_value_type(cube.values().type, [&]<class T>(std::type_identity<T>) {
        find_rows<T>(cube, from_ordinal<T>(static_cast<Ordinal<T>>(cut)), rows);
    });
}

/// @param out room for all cells and a vector more @return behind the last place
PlaceInChunk* write_places(const CubeRows& rows, PlaceInChunk* out) {
    // Words of 32 bits, which AVX-512 compresses in one step.
    const hn::CappedTag<std::uint32_t, kChunkEdge> d;
    const hn::Rebind<PlaceInChunk, decltype(d)> half;
    const auto write_row = [&](std::size_t row) HWY_ATTR {
        for (std::size_t x = 0; x < kChunkEdge; x += hn::Lanes(d)) {
            const auto first = static_cast<std::uint32_t>(row * kChunkEdge + x);
            const std::uint64_t part = rows[row] >> x & ((1u << hn::Lanes(d)) - 1);
            hn::StoreU(hn::TruncateTo(half, compress(d, hn::Iota(d, first), part)), half, out);
            out += hwy::PopCount(part);
        }
    };
    const hn::CappedTag<PlaceInChunk, kWordBits> of_rows;
    for (std::size_t first = 0; first < rows.size(); first += kWordBits) {
        std::uint64_t some = 0; // rows with cells: testing each costs more
        for (std::size_t i = 0; i < kWordBits; i += hn::Lanes(of_rows))
            some |= bits_of(of_rows,
                            hn::Ne(hn::LoadU(of_rows, rows.data() + first + i), hn::Zero(of_rows)))
                    << i;
        for (; some; some &= some - 1)
            write_row(first + hwy::Num0BitsBelowLS1Bit_Nonzero64(some));
    }
    return out;
}

void add_row_counts(const CubeRows& rows, RowCounts& counts) {
    const hn::CappedTag<std::uint32_t, kChunkEdge> d;
    const hn::Rebind<std::uint16_t, decltype(d)> half;
    for (std::size_t row = 0; row < rows.size(); row += hn::Lanes(d)) {
        const auto bits = hn::PopulationCount(hn::LoadU(half, rows.data() + row));
        hn::StoreU(hn::Add(hn::LoadU(d, counts.data() + row), hn::PromoteTo(d, bits)), d,
                   counts.data() + row);
    }
}

} // namespace
} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::index {

HWY_EXPORT(find_active_rows);
HWY_EXPORT(write_places);
HWY_EXPORT(add_row_counts);

namespace {

static_assert(kChunkBricks[0] == 2 && BrickGrid::kCells[0] == 8);

/// The bits that two bricks next to each other along x have in a row of cells.
constexpr std::array<std::uint16_t, 4> kRowOfBricks{0, 0xff, 0xff00, 0xffff};

} // namespace

CubeRows active_rows(const ChunkCube& cube, std::uint64_t cut, BricksOfChunk bricks) {
    CubeRows rows{};
    HWY_DYNAMIC_DISPATCH(find_active_rows)(cube, cut, rows);
    const auto& cells = cube.cells();
    for (std::uint32_t z = 0; z < kChunkEdge; ++z)
        for (std::uint32_t y = 0; y < kChunkEdge; ++y) {
            const std::uint32_t brick =
                kChunkBricks[0] *
                (y / BrickGrid::kCells[1] + kChunkBricks[1] * (z / BrickGrid::kCells[2]));
            // Rows beyond the chunk's own cells hold nothing of meaning.
            const bool inside = z < cells[2] && y < cells[1];
            if (!inside)
                rows[z * kChunkEdge + y] = 0;
            rows[z * kChunkEdge + y] &= kRowOfBricks[bricks >> brick & 3];
        }
    return rows;
}

SidesOfCells sides_of(const CubeRows& rows) {
    // First combines rows by their side along z, then the results by their side along y: plain
    // loops over many rows.
    std::array<std::array<std::uint16_t, kChunkEdge>, kSides> of_z{};
    for (std::uint32_t z = 0; z < kChunkEdge; ++z)
        for (std::uint32_t y = 0; y < kChunkEdge; ++y)
            of_z[kSide[z]][y] |= rows[z * kChunkEdge + y];
    std::array<std::uint16_t, kSides> along_x{};
    for (std::uint32_t x = 0; x < kChunkEdge; ++x)
        along_x[kSide[x]] = static_cast<std::uint16_t>(along_x[kSide[x]] | 1u << x);
    SidesOfCells sides = 0;
    for (unsigned z = 0; z < kSides; ++z)
        for (std::uint32_t y = 0; y < kChunkEdge; ++y)
            for (unsigned x = 0; x < kSides; ++x)
                sides |= SidesOfCells{(of_z[z][y] & along_x[x]) != 0}
                         << (x + kSides * (kSide[y] + kSides * z));
    return sides;
}

void keep_sides(SidesOfCells sides, CubeRows& rows) {
    std::array<std::uint16_t, kSides> along_x{};
    for (std::uint32_t x = 0; x < kChunkEdge; ++x)
        along_x[kSide[x]] = static_cast<std::uint16_t>(along_x[kSide[x]] | 1u << x);
    std::array<std::uint16_t, std::size_t{kSides} * kSides> kept{};
    for (unsigned i = 0; i < kept.size(); ++i)
        for (unsigned x = 0; x < kSides; ++x)
            if (sides >> (x + kSides * i) & 1)
                kept[i] |= along_x[x];
    for (std::uint32_t z = 0; z < kChunkEdge; ++z)
        for (std::uint32_t y = 0; y < kChunkEdge; ++y)
            rows[z * kChunkEdge + y] &= kept[kSide[y] + kSides * kSide[z]];
}

std::size_t append_places(const CubeRows& rows, std::vector<PlaceInChunk>& places) {
    std::array<PlaceInChunk, std::size_t{kChunkEdge} * kChunkEdge * kChunkEdge + kChunkEdge> found;
    const PlaceInChunk* const end = HWY_DYNAMIC_DISPATCH(write_places)(rows, found.data());
    places.insert(places.end(), static_cast<const PlaceInChunk*>(found.data()), end);
    return static_cast<std::size_t>(end - found.data());
}

void add_counts(const CubeRows& rows, RowCounts& counts) {
    HWY_DYNAMIC_DISPATCH(add_row_counts)(rows, counts);
}

std::uint64_t cells_of_bricks(BricksOfChunk bricks, const std::array<std::uint32_t, 3>& cells) {
    std::uint64_t count = 0;
    for (; bricks; bricks &= bricks - 1) {
        const auto i = static_cast<std::uint32_t>(std::countr_zero(bricks));
        const std::array<std::uint32_t, 3> at{i % kChunkBricks[0],
                                              i / kChunkBricks[0] % kChunkBricks[1],
                                              i / kChunkBricks[0] / kChunkBricks[1]};
        std::uint64_t size = 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::uint32_t first = at[axis] * BrickGrid::kCells[axis];
            size *=
                first < cells[axis] ? std::min(BrickGrid::kCells[axis], cells[axis] - first) : 0;
        }
        count += size;
    }
    return count;
}

} // namespace isochron::index
#endif
