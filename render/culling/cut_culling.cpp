// Culls cuts by tiles; compiled once for each SIMD target and chosen at run time.
#include "render/culling/culling.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/culling/cut_culling.cpp"
#include <hwy/foreach_target.h> // must come before highway.h

#include "render/culling/tile_rows_inl.h"
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace isochron::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// [pixels] by which GL's cuts may be larger or smaller than our cuts; each pixel is tested.
constexpr float kMargin = 1.0f / 64.0f;
/// Most rows of tiles of a cut. Larger ones are few: they are drawn, and hide nothing.
constexpr int kMostRows = 64;
constexpr int kLargestPart = 128; ///< [pixel] of a square around what is seen of a cut

using Span = hn::CappedTag<float, 8>; // most cuts have fewer rows of tiles
using SpanV = hn::Vec<Span>;

/// A quad that is a plane's part in a cell, and the rows of tiles that it touches.
class TiledCut {
  public:
    /// Ranges of tiles by row, inclusive.
    struct Ranges {
        std::array<std::int32_t, kMostRows + 8> from, to;
    };

    /// @param n number of the cut
    /// @param first, last rows of tiles that it touches
    HWY_INLINE TiledCut(const CellSquares& cuts, const TileNumbers& tiles, std::size_t n, int first,
                        int last)
        : tiles_(tiles), y_(cuts.y()[n]), low_(cuts.low()[n] - y_), high_(cuts.high()[n] - y_),
          first_(first), count_(last - first + 1) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const CellSquares::Stripe stripe = cuts.stripe(axis);
            stripes_[axis] = {cuts.x()[n] + stripe.middle[n], stripe.lean[n], stripe.half[n]};
        }
    }

    int rows() const { return count_; }
    float* row(int i) const { return tiles_.row(first_ + i); }
    /// Tiles in which it may cover the middle of a pixel.
    HWY_INLINE void touched(Ranges& out) const {
        each_rows([&](int i, SpanV first, SpanV last) HWY_ATTR {
            const auto low = hn::Max(hn::Sub(first, set(kMargin)), set(low_));
            const auto high = hn::Min(hn::Add(last, set(kMargin)), set(high_));
            const Sides sides = sides_within<true>(low, high);
            const auto from = tile(hn::Add(sides.left, set(0.5f - kMargin)));
            const auto to = tile(hn::Sub(sides.right, set(0.5f - kMargin)));
            const Ints di;
            hn::StoreU(hn::Max(from, hn::Zero(di)), di, out.from.data() + i);
            hn::StoreU(hn::Min(to, hn::Set(di, tiles_.columns - 1)), di, out.to.data() + i);
        });
    }
    /// Tiles in which it certainly covers the middles of all pixels.
    HWY_INLINE void covered(Ranges& out) const {
        const float size = static_cast<float>(1 << tiles_.bits);
        each_rows([&](int i, SpanV first, SpanV last) HWY_ATTR {
            const Sides sides =
                sides_within<false>(hn::Sub(first, set(kMargin)), hn::Add(last, set(kMargin)));
            const auto from = tile(hn::Add(sides.left, set(kMargin + size - 0.5f)));
            const auto end = tile(hn::Sub(sides.right, set(kMargin - 0.5f)));
            const Ints di;
            hn::StoreU(hn::Max(from, hn::Zero(di)), di, out.from.data() + i);
            hn::StoreU(hn::Sub(hn::Min(end, hn::Set(di, tiles_.columns)), hn::Set(di, 1)), di,
                       out.to.data() + i);
        });
    }

  private:
    using Ints = hn::RebindToSigned<Span>;
    /// As `CellSquares` has it, with its middle in the picture.
    struct Stripe {
        float middle, lean, half;
    };
    struct Sides {
        SpanV left, right;
    };

    static HWY_INLINE SpanV set(float value) { return hn::Set(Span(), value); }
    HWY_INLINE hn::Vec<Ints> tile(SpanV at) const {
        return hn::ShiftRightSame(pixel_at(at), tiles_.bits);
    }
    /// The columns that are in all stripes, at some height between two heights above `y_`
    /// (`kSomewhere`) or at every height between them.
    template <bool kSomewhere>
    HWY_INLINE Sides sides_within(SpanV low, SpanV high) const {
        const auto middle = hn::Mul(hn::Add(low, high), set(0.5f));
        const auto reach = hn::Max(hn::Sub(high, middle), set(0.0f));
        Sides sides{set(-4.0f * kFarthest), set(4.0f * kFarthest)};
        for (const Stripe& stripe : stripes_) {
            const auto at = hn::MulAdd(set(stripe.lean), middle, set(stripe.middle));
            const auto lean = set(kSomewhere ? std::abs(stripe.lean) : -std::abs(stripe.lean));
            const auto half = hn::MulAdd(lean, reach, set(stripe.half));
            sides.right = hn::Min(sides.right, hn::Add(at, half));
            sides.left = hn::Max(sides.left, hn::Sub(at, half));
        }
        return sides;
    }
    /// Calls `each` with some rows at a time: the middles of their first and their last pixels,
    /// above `y_`.
    template <class Each>
    HWY_INLINE void each_rows(Each&& each) const {
        const auto size = static_cast<float>(1 << tiles_.bits);
        for (int i = 0; i < count_; i += static_cast<int>(hn::Lanes(Span()))) {
            const auto number = hn::Iota(Span(), static_cast<float>(first_ + i));
            const auto first = hn::MulSub(number, set(size), set(y_ - 0.5f));
            each(i, first, hn::Add(first, set(size - 1.0f)));
        }
    }

    const TileNumbers& tiles_;
    float y_, low_, high_;
    std::array<Stripe, 3> stripes_;
    int first_, count_;
};

/// The smallest square of whole pixels around the part of a cut that may be seen; null if none may
/// be.
HWY_INLINE std::optional<PixelSquare> seen_part(const TiledCut& cut, const TileNumbers& tiles,
                                                const TiledCut::Ranges& touched, int first_row,
                                                float z) {
    const Row d;
    const auto nearer = hn::Set(d, z - kLevel);
    int left = tiles.columns, right = -1, low = -1, high = -1;
    for (int i = 0; i < cut.rows(); ++i) {
        float* const row = cut.row(i);
        all_of_row(row, touched.from[i], touched.to[i], [&](const float* at, auto which) HWY_ATTR {
            const auto seen = hn::And(which, hn::Ge(hn::LoadU(d, at), nearer));
            if (hn::AllFalse(d, seen))
                return true;
            std::array<std::uint8_t, 8> bytes{};
            hn::StoreMaskBits(d, seen, bytes.data());
            const auto bits = std::bit_cast<std::uint64_t>(bytes);
            const int column = static_cast<int>(at - row);
            left = std::min(left, column + std::countr_zero(bits));
            right = std::max(right, column + 63 - std::countl_zero(bits));
            low = low < 0 ? i : low;
            high = i;
            return true;
        });
    }
    if (right < 0)
        return std::nullopt;
    const int size = (std::max(right - left, high - low) + 1) << tiles.bits;
    const auto x = static_cast<std::uint32_t>(left << tiles.bits);
    const auto y = static_cast<std::uint32_t>((first_row + low) << tiles.bits);
    return PixelSquare{x | y << 16, size <= kLargestPart ? static_cast<std::uint32_t>(size) : 0u};
}

/// Rows of tiles in which cuts may cover the middle of a pixel.
HWY_INLINE void touched_rows(const TileNumbers& tiles, const float* low, const float* high,
                             Tiles& out) {
    const BlockFloats d;
    const BlockInts di;
    const auto to_middle = hn::Set(d, 0.5f - kMargin);
    for (std::size_t i = 0; i < CellSquares::kBlock; i += hn::Lanes(d)) {
        const auto first = pixel_at(hn::Add(hn::LoadU(d, low + i), to_middle));
        const auto last = pixel_at(hn::Sub(hn::LoadU(d, high + i), to_middle));
        hn::StoreU(hn::Max(hn::ShiftRightSame(first, tiles.bits), hn::Zero(di)), di,
                   out.first.data() + i);
        hn::StoreU(hn::Min(hn::ShiftRightSame(last, tiles.bits), hn::Set(di, tiles.rows - 1)), di,
                   out.last.data() + i);
    }
}

} // namespace

std::size_t find(const CellSquares& cuts, const TileNumbers& tiles, CellRange range,
                 std::uint32_t* seen, PixelSquare* parts) {
    Tiles up;
    TiledCut::Ranges ranges;
    std::size_t count = 0;
    for (std::size_t first = range.first; first < range.end; first += CellSquares::kBlock) {
        touched_rows(tiles, cuts.low() + first, cuts.high() + first, up);
        const std::size_t cells = std::min(range.end - first, CellSquares::kBlock);
        for (std::size_t i = 0; i < cells; ++i) {
            const std::size_t n = first + i;
            const int rows = up.last[i] - up.first[i] + 1;
            if (rows < 1)
                continue;
            if (rows > kMostRows) {
                parts[count] = {};
                seen[count++] = static_cast<std::uint32_t>(n);
                continue;
            }
            const TiledCut cut(cuts, tiles, n, up.first[i], up.last[i]);
            const float z = cuts.z()[n];
            cut.touched(ranges);
            const std::optional<PixelSquare> part = seen_part(cut, tiles, ranges, up.first[i], z);
            if (!part)
                continue;
            parts[count] = *part;
            seen[count++] = static_cast<std::uint32_t>(n);
            if (cuts.inner()[n] == 0.0f)
                continue;
            cut.covered(ranges);
            for (int row = 0; row < rows; ++row)
                cover_row(cut.row(row), ranges.from[row], ranges.to[row], z);
        }
    }
    return count;
}

} // namespace isochron::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::render {

HWY_EXPORT(find);

std::size_t find_cuts(const CellSquares& cuts, const TileNumbers& tiles, CellRange range,
                      std::uint32_t* seen, PixelSquare* parts) {
    return HWY_DYNAMIC_DISPATCH(find)(cuts, tiles, range, seen, parts);
}

} // namespace isochron::render
#endif
