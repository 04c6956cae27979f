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

/// The tiles of the middles of a block of ellipses; -1 if it is outside the view.
HWY_INLINE void tiles_of_middles(const TileNumbers& tiles, const float* x, const float* y,
                                 std::array<std::int32_t, CellSquares::kBlock>& out) {
    const Floats d;
    const Ints di;
    const auto columns = hn::Set(di, tiles.columns), rows = hn::Set(di, tiles.rows);
    for (std::size_t i = 0; i < CellSquares::kBlock; i += hn::Lanes(d)) {
        const auto column = hn::ShiftRightSame(pixel_at(hn::LoadU(d, x + i)), tiles.bits);
        const auto row = hn::ShiftRightSame(pixel_at(hn::LoadU(d, y + i)), tiles.bits);
        const auto inside =
            hn::And(hn::And(hn::Gt(column, hn::Set(di, -1)), hn::Lt(column, columns)),
                    hn::And(hn::Gt(row, hn::Set(di, -1)), hn::Lt(row, rows)));
        const auto tile = hn::Add(hn::Mul(row, columns), column);
        hn::StoreU(hn::IfThenElse(inside, tile, hn::Set(di, -1)), di, out.data() + i);
    }
}

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
    /// @param first, last rows of tiles that it touches
    HWY_INLINE TiledEllipse(const CellSquares& ellipses, const TileNumbers& tiles, std::size_t n,
                            int first, int last)
        : tiles_(tiles), x_(ellipses.x()[n]), y_(ellipses.y()[n]), lean_(ellipses.lean()[n]),
          half_(ellipses.half()[n]), up_(ellipses.up()[n]), first_(first),
          count_(last - first + 1) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const CellSquares::Stripe stripe = ellipses.stripe(axis);
            stripes_[axis] = stripe.middle
                                 ? Stripe{x_ + stripe.middle[n], stripe.lean[n], stripe.half[n]}
                                 : Stripe{x_, 0.0f, std::numeric_limits<float>::max()};
        }
    }

    int rows() const { return count_; }
    float* row(int i) const {
        return tiles_.numbers + static_cast<std::size_t>(first_ + i) * tiles_.columns;
    }
    /// Tiles in which it may cover the middle of a pixel.
    /// @param tip height of the point farthest to the right
    HWY_INLINE void touched(float tip, Ranges& out) const {
        each_rows([&](int i, SpanV low, SpanV high) HWY_ATTR {
            const auto least = hn::Clamp(hn::Sub(low, set(kMargin)), set(-up_), set(up_));
            const auto most = hn::Clamp(hn::Add(high, set(kMargin)), set(-up_), set(up_));
            const auto at_right = hn::Clamp(set(tip), least, most);
            const auto at_left = hn::Clamp(set(-tip), least, most);
            auto right = right_at(at_right), left = left_at(at_left);
            const auto middle = hn::Mul(hn::Add(least, most), set(0.5f));
            const auto reach = hn::Sub(most, middle);
            for (const Stripe& stripe : stripes_) {
                const auto at = stripe.at(middle);
                const auto half = hn::MulAdd(set(std::abs(stripe.lean)), reach, set(stripe.half));
                right = hn::Min(right, hn::Add(at, half));
                left = hn::Max(left, hn::Sub(at, half));
            }
            right = hn::Add(right, set(kMargin));
            left = hn::Sub(left, set(kMargin));
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
            auto right = hn::Min(right_at(first), right_at(last));
            auto left = hn::Max(left_at(first), left_at(last));
            const auto middle = hn::Mul(hn::Add(first, last), set(0.5f));
            const auto reach = hn::Sub(last, middle);
            for (const Stripe& stripe : stripes_) {
                const auto at = stripe.at(middle);
                const auto half =
                    hn::NegMulAdd(set(std::abs(stripe.lean)), reach, set(stripe.half));
                right = hn::Min(right, hn::Add(at, half));
                left = hn::Max(left, hn::Sub(at, half));
            }
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
    /// As `CellSquares` has it, with its middle in the picture.
    struct Stripe {
        float middle, lean, half;
        HWY_INLINE SpanV at(SpanV height) const {
            return hn::MulAdd(hn::Set(Span(), lean), height, hn::Set(Span(), middle));
        }
    };

    static HWY_INLINE SpanV set(float value) { return hn::Set(Span(), value); }
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
    std::array<Stripe, 3> stripes_;
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
std::size_t find_ellipses(const CellSquares& ellipses, const TileNumbers& tiles, std::size_t from,
                          std::size_t end, std::uint32_t* seen) {
    Tiles up;
    TiledEllipse::Ranges ranges;
    std::array<std::int32_t, CellSquares::kBlock> middles;
    std::size_t count = 0;
    for (std::size_t first = from; first < end; first += CellSquares::kBlock) {
        touched(tiles, ellipses.y() + first, ellipses.up() + first, tiles.rows, up);
        tiles_of_middles(tiles, ellipses.x() + first, ellipses.y() + first, middles);
        const std::size_t cells = std::min(end - first, CellSquares::kBlock);
        for (std::size_t i = 0; i < cells; ++i) {
            const std::size_t n = first + i;
            const int rows = up.last[i] - up.first[i] + 1;
            if (rows < 1)
                continue;
            const TiledEllipse ellipse(ellipses, tiles, n, up.first[i], up.last[i]);
            const float z = ellipses.z()[n];
            const bool large = rows > kMostRows;
            // Most visible ellipses are visible in the middle, so test that first.
            if (!large && !(middles[i] >= 0 && tiles.numbers[middles[i]] >= z - kLevel)) {
                ellipse.touched(ellipses.tip()[n], ranges);
                if (hidden(ellipse, ranges, z))
                    continue;
            }
            seen[count++] = static_cast<std::uint32_t>(n);
            if (large || ellipses.inner()[n] == 0.0f)
                continue;
            ellipse.covered(ranges);
            for (int row = 0; row < rows; ++row)
                cover_row(ellipse.row(row), ranges.from[row], ranges.to[row], z);
        }
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
    // With this size most quads cover some tiles.
    constexpr float kTilesAcross = 1.5f; // half of a quad
    constexpr int kMostTileBits = 4;
    tiles.lay_out(view, {ellipses_ ? squares.inner_disc() : squares.inner(), squares.size()},
                  kTilesAcross, kMostTileBits, std::numeric_limits<float>::max());
}

std::size_t SeenCells::visit(const CellSquares& squares, const TileNumbers& tiles,
                             std::size_t first, std::size_t end, std::uint32_t* seen) {
    return ellipses_ ? HWY_DYNAMIC_DISPATCH(find_ellipses)(squares, tiles, first, end, seen)
                     : HWY_DYNAMIC_DISPATCH(find)(squares, tiles, first, end, seen);
}

} // namespace isochron::render
#endif
