// Tiles that quads cover, and quads whose tiles are covered; compiled once for each SIMD target and
// chosen at run time.
#include "render/cells/quad_culling.h"

#include <algorithm>
#include <array>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cells/quad_culling.cpp"
#include <hwy/foreach_target.h> // must come before highway.h

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace isochron::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// [pixels] by which GL's quads may be larger or smaller than ours: it rounds to 1/256.
constexpr float kMargin = 1.0f / 16.0f;
/// Of clip depth: rounded otherwise on the way through GL, what is as good as level hides nothing.
constexpr float kLevel = 1e-6f;

using Floats = hn::CappedTag<float, CellSquares::kBlock>;
using Ints = hn::RebindToSigned<Floats>;
using Row = hn::CappedTag<float, TileNumbers::kSlack>;

/// Inclusive ranges of tiles along one axis for a block of cells; empty where `last` is less than
/// `first`.
struct Tiles {
    std::array<std::int32_t, CellSquares::kBlock> first, last;
};

/// The pixel that a place is in; far beyond any view somewhere there.
HWY_INLINE hn::Vec<Ints> pixel_at(hn::Vec<Floats> at) {
    const Floats d;
    const auto near = hn::Clamp(at, hn::Set(d, -65536.0f), hn::Set(d, 65536.0f));
    return hn::ConvertTo(Ints(), hn::Floor(near));
}

/// Tiles of which the quad may draw the middle of a pixel.
HWY_INLINE void touched(const TileNumbers& tiles, const float* middle, const float* half, int count,
                        Tiles& out) {
    const Floats d;
    const Ints di;
    for (std::size_t i = 0; i < CellSquares::kBlock; i += hn::Lanes(d)) {
        const auto at = hn::LoadU(d, middle + i);
        const auto reach = hn::Add(hn::LoadU(d, half + i), hn::Set(d, kMargin));
        const auto first = hn::ShiftRightSame(pixel_at(hn::Sub(at, reach)), tiles.bits);
        const auto last = hn::ShiftRightSame(pixel_at(hn::Add(at, reach)), tiles.bits);
        hn::StoreU(hn::Max(first, hn::Zero(di)), di, out.first.data() + i);
        hn::StoreU(hn::Min(last, hn::Set(di, count - 1)), di, out.last.data() + i);
    }
}

/// Tiles of which the quad surely draws the middles of all pixels.
HWY_INLINE void covered(const TileNumbers& tiles, const float* middle, const float* half, int count,
                        Tiles& out) {
    const Floats d;
    const Ints di;
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

/// A row's tiles from one to another, as whole vectors: `each(tiles, which)` until it is false.
template <class Each>
HWY_INLINE bool all_of_row(float* row, int first, int last, Each&& each) {
    const Row d;
    for (int at = first; at <= last; at += static_cast<int>(hn::Lanes(d)))
        if (!each(row + at, hn::FirstN(d, static_cast<std::size_t>(last - at) + 1)))
            return false;
    return true;
}

HWY_INLINE bool hidden(const TileNumbers& tiles, const Tiles& across, const Tiles& up,
                       std::size_t i, float z) {
    const Row d;
    const auto nearer = hn::Set(d, z - kLevel);
    for (int y = up.first[i]; y <= up.last[i]; ++y) {
        float* const row = tiles.numbers + static_cast<std::size_t>(y) * tiles.columns;
        if (!all_of_row(row, across.first[i], across.last[i], [&](const float* at, auto which) {
                return hn::AllFalse(d, hn::And(which, hn::Ge(hn::LoadU(d, at), nearer)));
            }))
            return false;
    }
    return true;
}

HWY_INLINE void cover(const TileNumbers& tiles, const Tiles& across, const Tiles& up, std::size_t i,
                      float z) {
    const Row d;
    const auto depth = hn::Set(d, z);
    for (int y = up.first[i]; y <= up.last[i]; ++y) {
        float* const row = tiles.numbers + static_cast<std::size_t>(y) * tiles.columns;
        all_of_row(row, across.first[i], across.last[i], [&](float* at, auto which) {
            const auto before = hn::LoadU(d, at);
            hn::StoreU(hn::IfThenElse(which, hn::Min(before, depth), before), d, at);
            return true;
        });
    }
}

} // namespace

/// @param seen numbers of cells in the order of the squares: room for all of them
/// @return how many
std::size_t find(const CellSquares& squares, const TileNumbers& tiles, std::uint32_t* seen) {
    Tiles across, up, whole_across, whole_up;
    std::size_t count = 0;
    for (std::size_t first = 0; first < squares.size(); first += CellSquares::kBlock) {
        const float *x = squares.x() + first, *y = squares.y() + first, *z = squares.z() + first;
        touched(tiles, x, squares.outer() + first, tiles.columns, across);
        touched(tiles, y, squares.outer() + first, tiles.rows, up);
        covered(tiles, x, squares.inner() + first, tiles.columns, whole_across);
        covered(tiles, y, squares.inner() + first, tiles.rows, whole_up);
        const std::size_t cells = std::min(squares.size() - first, CellSquares::kBlock);
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

std::span<const std::uint32_t> SeenCells::find(const View& view, const Placement& placement,
                                               float radius, std::span<const CellPlace> places,
                                               std::span<const std::uint32_t> back_to_front) {
    squares_.project(view, placement, radius, places, back_to_front);
    // Most quads cover some tiles.
    constexpr float kTilesAcross = 1.5f; ///< half of a quad
    constexpr int kMostTileBits = 4;
    tiles_.lay_out(view, {squares_.inner(), squares_.size()}, kTilesAcross, kMostTileBits,
                   std::numeric_limits<float>::max());
    seen_.resize(squares_.size());
    seen_.resize(HWY_DYNAMIC_DISPATCH(find)(squares_, tiles_.numbers(), seen_.data()));
    for (std::uint32_t& cell : seen_)
        cell = back_to_front[squares_.size() - 1 - cell];
    return seen_;
}

} // namespace isochron::render
#endif
