// Occlusion culling of quads by tiles; compiled once for each SIMD target and chosen at run time.
#include "render/culling/culling.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/culling/quad_culling.cpp"
#include <hwy/foreach_target.h> // must come before highway.h

#include "render/culling/tile_rows_inl.h"
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace isochron::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// [pixels] by which GL's quads may be larger or smaller than ours, as GL rounds to 1/256.
constexpr float kMargin = 1.0f / 16.0f;

/// Tiles in which the quad may cover the middle of a pixel.
HWY_INLINE void touched(const TileNumbers& tiles, const float* middle, const float* half, int count,
                        Tiles& out) {
    const BlockFloats d;
    const BlockInts di;
    for (std::size_t i = 0; i < CellSquares::kBlock; i += hn::Lanes(d)) {
        const auto at = hn::LoadU(d, middle + i);
        const auto reach = hn::Add(hn::LoadU(d, half + i), hn::Set(d, kMargin));
        const auto first = hn::ShiftRightSame(pixel_at(hn::Sub(at, reach)), tiles.bits);
        const auto last = hn::ShiftRightSame(pixel_at(hn::Add(at, reach)), tiles.bits);
        hn::StoreU(hn::Max(first, hn::Zero(di)), di, out.first.data() + i);
        hn::StoreU(hn::Min(last, hn::Set(di, count - 1)), di, out.last.data() + i);
    }
}

/// Tiles in which the quad certainly covers the middles of all pixels.
HWY_INLINE void covered(const TileNumbers& tiles, const float* middle, const float* half, int count,
                        Tiles& out) {
    const BlockFloats d;
    const BlockInts di;
    for (std::size_t i = 0; i < CellSquares::kBlock; i += hn::Lanes(d)) {
        const auto at = hn::LoadU(d, middle + i);
        const auto reach = hn::Sub(hn::LoadU(d, half + i), hn::Set(d, kMargin - 0.5f));
        const auto up = hn::Set(di, 1 << tiles.bits); // to the next whole tile
        const auto first =
            hn::ShiftRightSame(hn::Add(pixel_at(hn::Sub(at, reach)), up), tiles.bits);
        const auto end = hn::ShiftRightSame(pixel_at(hn::Add(at, reach)), tiles.bits);
        hn::StoreU(hn::Max(first, hn::Zero(di)), di, out.first.data() + i);
        hn::StoreU(hn::Sub(hn::Min(end, hn::Set(di, count)), hn::Set(di, 1)), di,
                   out.last.data() + i);
    }
}

HWY_INLINE bool hidden(const TileNumbers& tiles, const Tiles& across, const Tiles& up,
                       std::size_t i, float z) {
    const Row d;
    const auto nearer = hn::Set(d, z - kLevel);
    for (int y = up.first[i]; y <= up.last[i]; ++y) {
        if (!all_of_row(
                tiles.row(y), across.first[i], across.last[i], [&](const float* at, auto which) {
                    return hn::AllFalse(d, hn::And(which, hn::Ge(hn::LoadU(d, at), nearer)));
                }))
            return false;
    }
    return true;
}

HWY_INLINE void cover(const TileNumbers& tiles, const Tiles& across, const Tiles& up, std::size_t i,
                      float z) {
    for (int y = up.first[i]; y <= up.last[i]; ++y)
        cover_row(tiles.row(y), across.first[i], across.last[i], z);
}

} // namespace

std::size_t find(const CellSquares& squares, const TileNumbers& tiles, CellRange range,
                 std::uint32_t* seen) {
    Tiles across, up, whole_across, whole_up;
    std::size_t count = 0;
    for (std::size_t first = range.first; first < range.end; first += CellSquares::kBlock) {
        const float *x = squares.x() + first, *y = squares.y() + first, *z = squares.z() + first;
        touched(tiles, x, squares.outer() + first, tiles.columns, across);
        touched(tiles, y, squares.outer() + first, tiles.rows, up);
        covered(tiles, x, squares.inner() + first, tiles.columns, whole_across);
        covered(tiles, y, squares.inner() + first, tiles.rows, whole_up);
        const std::size_t cells = std::min(range.end - first, CellSquares::kBlock);
        for (std::size_t i = 0; i < cells; ++i) {
            if (hidden(tiles, across, up, i, z[i]))
                continue;
            seen[count++] = static_cast<std::uint32_t>(first + i);
            cover(tiles, whole_across, whole_up, i, z[i]);
        }
    }
    return count;
}

} // namespace isochron::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::render {

HWY_EXPORT(find);

std::size_t find_squares(const CellSquares& squares, const TileNumbers& tiles, CellRange range,
                         std::uint32_t* seen) {
    return HWY_DYNAMIC_DISPATCH(find)(squares, tiles, range, seen);
}

} // namespace isochron::render
#endif
