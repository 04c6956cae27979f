// Occlusion culling of quads by tiles; compiled once for each SIMD target and chosen at run time.
#include "render/cells/quad_culling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cells/quad_culling.cpp"
#include <hwy/foreach_target.h> // must come before highway.h

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace isochron::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// [pixels] by which GL's quads may be larger or smaller than ours, as GL rounds to 1/256.
constexpr float kMargin = 1.0f / 16.0f;
/// Least difference of clip depths at which the nearer quad hides the other: GL rounds depths
/// differently.
constexpr float kLevel = 1e-6f;

using Floats = hn::CappedTag<float, CellSquares::kBlock>;
using Ints = hn::RebindToSigned<Floats>;
using Row = hn::CappedTag<float, TileNumbers::kSlack>;

/// Inclusive ranges of tiles along one axis for a block of cells; empty if `last` < `first`.
struct Tiles {
    std::array<std::int32_t, CellSquares::kBlock> first, last;
};

/// The pixel at a place; places far outside any view are clamped.
HWY_INLINE hn::Vec<Ints> pixel_at(hn::Vec<Floats> at) {
    const Floats d;
    const auto near = hn::Clamp(at, hn::Set(d, -65536.0f), hn::Set(d, 65536.0f));
    return hn::ConvertTo(Ints(), hn::Floor(near));
}

/// Tiles in which the quad may cover the middle of a pixel.
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

/// Tiles in which the quad certainly covers the middles of all pixels.
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

/// Visits the tiles of a row from `first` to `last`, a vector at a time: calls `each(tiles, which)`
/// until it returns false.
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

HWY_INLINE void cover_row(float* row, int first, int last, float z) {
    const Row d;
    all_of_row(row, first, last, [&](float* at, auto which) {
        const auto before = hn::LoadU(d, at);
        hn::StoreU(hn::IfThenElse(which, hn::Min(before, hn::Set(d, z)), before), d, at);
        return true;
    });
}

HWY_INLINE void cover(const TileNumbers& tiles, const Tiles& across, const Tiles& up, std::size_t i,
                      float z) {
    for (int y = up.first[i]; y <= up.last[i]; ++y)
        cover_row(tiles.numbers + static_cast<std::size_t>(y) * tiles.columns, across.first[i],
                  across.last[i], z);
}

/// Most rows of tiles of an ellipse. Larger ellipses are few: they are drawn, and hide nothing.
constexpr int kMostRows = 64;
constexpr float kFarthest = 65536.0f; ///< [pixel] beyond any view

using Span = hn::CappedTag<float, 8>; // most ellipses have fewer rows of tiles
using SpanV = hn::Vec<Span>;

/// An ellipse and the rows of tiles that it touches.
class TiledEllipse {
  public:
    /// Ranges of tiles by row, inclusive.
    struct Ranges {
        std::array<std::int32_t, kMostRows + 8> from, to;
    };

    /// @param n number of the ellipse
    HWY_INLINE TiledEllipse(const CellSquares& ellipses, const TileNumbers& tiles, std::size_t n)
        : tiles_(tiles), x_(ellipses.x()[n]), y_(ellipses.y()[n]) {
        const float xy = ellipses.xy()[n], yy = ellipses.yy()[n];
        lean_ = xy / yy;
        half_ = std::sqrt(std::max(ellipses.xx()[n] - xy * lean_, 0.0f));
        up_ = std::sqrt(yy);
        first_ = std::max(tile_at(y_ - up_ - kMargin), 0);
        count_ = std::min(tile_at(y_ + up_ + kMargin), tiles.rows - 1) - first_ + 1;
    }

    int rows() const { return count_; }
    float* row(int i) const {
        return tiles_.numbers + static_cast<std::size_t>(first_ + i) * tiles_.columns;
    }
    /// The tile of its middle; null if that is outside the view.
    const float* middle() const {
        const int column = tile_at(x_), at = tile_at(y_);
        if (column < 0 || column >= tiles_.columns || at < 0 || at >= tiles_.rows)
            return nullptr;
        return tiles_.numbers + static_cast<std::size_t>(at) * tiles_.columns + column;
    }

    /// Tiles in which it may cover the middle of a pixel.
    HWY_INLINE void touched(float xx, float xy, Ranges& out) const {
        const float rightmost = xy / std::sqrt(xx); // height of the point farthest to the right
        each_rows([&](int i, SpanV low, SpanV high) HWY_ATTR {
            const auto least = hn::Clamp(hn::Sub(low, set(kMargin)), set(-up_), set(up_));
            const auto most = hn::Clamp(hn::Add(high, set(kMargin)), set(-up_), set(up_));
            const auto at_right = hn::Clamp(set(rightmost), least, most);
            const auto at_left = hn::Clamp(set(-rightmost), least, most);
            const auto right = hn::Add(right_at(at_right), set(kMargin));
            const auto left = hn::Sub(left_at(at_left), set(kMargin));
            const Ints di;
            hn::StoreU(hn::Max(tile(left), hn::Zero(di)), di, out.from.data() + i);
            hn::StoreU(hn::Min(tile(right), hn::Set(di, tiles_.columns - 1)), di,
                       out.to.data() + i);
        });
    }

    /// Tiles in which it certainly covers the middles of all pixels.
    HWY_INLINE void covered(Ranges& out) const {
        const float size = static_cast<float>(1 << tiles_.bits);
        each_rows([&](int i, SpanV low, SpanV high) HWY_ATTR {
            // The middles of the first and the last row of pixels.
            const auto first = hn::Add(low, set(0.5f - kMargin));
            const auto last = hn::Sub(high, set(0.5f - kMargin));
            const auto inside = hn::And(hn::Ge(first, set(-up_)), hn::Le(last, set(up_)));
            const auto right = hn::Min(right_at(first), right_at(last));
            const auto left = hn::Max(left_at(first), left_at(last));
            const Ints di;
            const auto from = tile(hn::Add(left, set(kMargin + size - 0.5f)));
            const auto end = tile(hn::Sub(right, set(kMargin - 0.5f)));
            const auto to = hn::Sub(hn::Min(end, hn::Set(di, tiles_.columns)), hn::Set(di, 1));
            hn::StoreU(hn::Max(from, hn::Zero(di)), di, out.from.data() + i);
            hn::StoreU(hn::IfThenElse(hn::RebindMask(di, inside), to, hn::Set(di, -1)), di,
                       out.to.data() + i);
        });
    }

  private:
    using Ints = hn::RebindToSigned<Span>;

    static HWY_INLINE SpanV set(float value) { return hn::Set(Span(), value); }
    HWY_INLINE int tile_at(float at) const {
        return static_cast<int>(std::floor(std::clamp(at, -kFarthest, kFarthest))) >> tiles_.bits;
    }
    HWY_INLINE hn::Vec<Ints> tile(SpanV at) const {
        const auto near = hn::Clamp(at, set(-kFarthest), set(kFarthest));
        return hn::ShiftRightSame(hn::ConvertTo(Ints(), hn::Floor(near)), tiles_.bits);
    }
    /// Half its width at a height above its middle.
    HWY_INLINE SpanV reach(SpanV at) const {
        const auto part = hn::Mul(at, set(1.0f / up_));
        return hn::Mul(set(half_),
                       hn::Sqrt(hn::Max(hn::NegMulAdd(part, part, set(1.0f)), hn::Zero(Span()))));
    }
    HWY_INLINE SpanV right_at(SpanV at) const {
        return hn::Add(hn::MulAdd(set(lean_), at, set(x_)), reach(at));
    }
    HWY_INLINE SpanV left_at(SpanV at) const {
        return hn::Sub(hn::MulAdd(set(lean_), at, set(x_)), reach(at));
    }
    /// Calls `each` with some rows at a time: their lower and upper ends relative to its middle.
    template <class Each>
    HWY_INLINE void each_rows(Each&& each) const {
        const auto size = static_cast<float>(1 << tiles_.bits);
        for (int i = 0; i < count_; i += static_cast<int>(hn::Lanes(Span()))) {
            const auto number = hn::Iota(Span(), static_cast<float>(first_ + i));
            const auto low = hn::MulSub(number, set(size), set(y_));
            each(i, low, hn::Add(low, set(size)));
        }
    }

    const TileNumbers& tiles_;
    float x_, y_, lean_, half_, up_;
    int first_, count_;
};

HWY_INLINE bool hidden(const TiledEllipse& ellipse, const TiledEllipse::Ranges& touched, float z) {
    const Row d;
    const auto nearer = hn::Set(d, z - kLevel);
    for (int i = 0; i < ellipse.rows(); ++i)
        if (!all_of_row(
                ellipse.row(i), touched.from[i], touched.to[i], [&](const float* at, auto which) {
                    return hn::AllFalse(d, hn::And(which, hn::Ge(hn::LoadU(d, at), nearer)));
                }))
            return false;
    return true;
}

} // namespace

/// The same as `find`, for ellipses.
std::size_t find_ellipses(const CellSquares& ellipses, const TileNumbers& tiles, std::size_t first,
                          std::size_t end, std::uint32_t* seen) {
    TiledEllipse::Ranges ranges;
    std::size_t count = 0;
    for (std::size_t n = first; n < end; ++n) {
        const TiledEllipse ellipse(ellipses, tiles, n);
        const float z = ellipses.z()[n];
        if (ellipse.rows() < 1)
            continue;
        const bool large = ellipse.rows() > kMostRows;
        // Most visible ellipses are visible in the middle, so test that first.
        const float* const middle = ellipse.middle();
        if (!large && !(middle && *middle >= z - kLevel)) {
            ellipse.touched(ellipses.xx()[n], ellipses.xy()[n], ranges);
            if (hidden(ellipse, ranges, z))
                continue;
        }
        seen[count++] = static_cast<std::uint32_t>(n);
        if (large || ellipses.inner()[n] == 0.0f)
            continue;
        ellipse.covered(ranges);
        for (int i = 0; i < ellipse.rows(); ++i)
            cover_row(ellipse.row(i), ranges.from[i], ranges.to[i], z);
    }
    return count;
}

/// Finds the visible ones of the cells from number `from`, a multiple of the block, to `end`.
/// @param seen takes their numbers in the order of the squares; has room for all of them
/// @return how many these are
std::size_t find(const CellSquares& squares, const TileNumbers& tiles, std::size_t from,
                 std::size_t end, std::uint32_t* seen) {
    Tiles across, up, whole_across, whole_up;
    std::size_t count = 0;
    for (std::size_t first = from; first < end; first += CellSquares::kBlock) {
        const float *x = squares.x() + first, *y = squares.y() + first, *z = squares.z() + first;
        touched(tiles, x, squares.outer() + first, tiles.columns, across);
        touched(tiles, y, squares.outer() + first, tiles.rows, up);
        covered(tiles, x, squares.inner() + first, tiles.columns, whole_across);
        covered(tiles, y, squares.inner() + first, tiles.rows, whole_up);
        const std::size_t cells = std::min(end - first, CellSquares::kBlock);
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
HWY_EXPORT(find_ellipses);

void SeenCells::lay_out(const View& view, const CellSquares& squares, PictureTiles& tiles) {
    // With these sizes most quads cover some tiles. Ellipses need larger tiles, as each row takes
    // longer.
    const float tiles_across = ellipses_ ? 1.0f : 1.5f; // half of a quad
    constexpr int kMostTileBits = 4;
    tiles.lay_out(view, {ellipses_ ? squares.inner_disc() : squares.inner(), squares.size()},
                  tiles_across, kMostTileBits, std::numeric_limits<float>::max());
}

std::size_t SeenCells::visit(const CellSquares& squares, const TileNumbers& tiles,
                             std::size_t first, std::size_t end, std::uint32_t* seen) {
    return ellipses_ ? HWY_DYNAMIC_DISPATCH(find_ellipses)(squares, tiles, first, end, seen)
                     : HWY_DYNAMIC_DISPATCH(find)(squares, tiles, first, end, seen);
}

} // namespace isochron::render
#endif
