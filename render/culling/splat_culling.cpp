// Occlusion culling of splats by tiles; compiled once for each SIMD target and chosen at run time.
#include "render/culling/culling.h"

#include <algorithm>
#include <array>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/culling/splat_culling.cpp"
#include <hwy/foreach_target.h> // must come before highway.h

#include "render/culling/tile_rows_inl.h"
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace isochron::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// If less light than this comes through, nothing behind changes a byte by more than its rounding.
constexpr float kDark = 1.0f / 512.0f;
/// [pixels] by which GL's position of a splat may differ.
constexpr float kMargin = 1.0f / 16.0f;
/// [pixels] from the middle of a pixel to its farthest sample: along an outline, a splat may cover
/// only some samples.
constexpr float kToSample = 0.75f;
/// Most tiles along an axis of a splat. Larger splats are few, and testing them takes long: they
/// are drawn, and hide nothing.
constexpr int kMostTiles = 96;

using Floats = std::array<float, kMostTiles + TileNumbers::kSlack>;
using Ints = std::array<std::int32_t, kMostTiles + TileNumbers::kSlack>;

/// The tiles that a splat touches along one axis. For each, its factor of the Gaussian at the
/// sample farthest from the splat's middle; 0 after the last tile.
struct Profile {
    int first = 0, count = 0; ///< count below 1: outside the view
    Floats gaussian;
    Floats nearest; ///< distance of the nearest sample
};

/// Tiles of each row that a disc touches, counted from the first of the profile.
struct Spans {
    Ints first, end;
};

/// A lower bound of 2^x for x <= 0, close for small |x|: (1 + x ln 2 / 256)^256.
HWY_INLINE hn::Vec<Row> below_exp2(hn::Vec<Row> x) {
    const Row d;
    constexpr int kSquarings = 8;
    constexpr float kScale = 0.693147f / (1 << kSquarings);
    auto power = hn::Max(hn::MulAdd(x, hn::Set(d, kScale), hn::Set(d, 1.0f)), hn::Zero(d));
    for (int i = 0; i < kSquarings; ++i)
        power = hn::Mul(power, power);
    return power;
}

HWY_INLINE int tile_of(const TileNumbers& tiles, float at) {
    return static_cast<int>(std::floor(std::clamp(at, -kFarthest, kFarthest))) >> tiles.bits;
}

/// @param middle, reach middle and radius of the splat [pixel]
/// @param falloff per square pixel
/// @return false when there are too many tiles
HWY_INLINE bool make_profile(const TileNumbers& tiles, float middle, float reach, float falloff,
                             int count, Profile& out) {
    out.first = std::max(tile_of(tiles, middle - reach - kMargin), 0);
    out.count = std::min(tile_of(tiles, middle + reach + kMargin), count - 1) - out.first + 1;
    if (out.count > kMostTiles)
        return false;
    const Row d;
    const float tile = static_cast<float>(1 << tiles.bits);
    const auto half = hn::Set(d, 0.5f * (tile - 1.0f));
    for (int i = 0; i < out.count; i += static_cast<int>(hn::Lanes(d))) {
        const auto number = hn::Iota(d, static_cast<float>(out.first + i));
        const auto center = hn::Mul(hn::Add(number, hn::Set(d, 0.5f)), hn::Set(d, tile));
        const auto off = hn::Abs(hn::Sub(center, hn::Set(d, middle)));
        const auto farthest = hn::Add(off, hn::Add(half, hn::Set(d, kMargin)));
        const auto nearest =
            hn::Max(hn::Sub(off, hn::Add(half, hn::Set(d, kToSample))), hn::Zero(d));
        const auto gaussian = below_exp2(hn::Mul(hn::Set(d, falloff), hn::Mul(farthest, farthest)));
        const auto inside = hn::FirstN(d, static_cast<std::size_t>(out.count - i));
        hn::StoreU(hn::IfThenElseZero(inside, gaussian), d, out.gaussian.data() + i);
        hn::StoreU(nearest, d, out.nearest.data() + i);
    }
    return true;
}

/// Finds the spans of a disc with this radius in the rows of `up`.
HWY_INLINE void find_spans(const TileNumbers& tiles, const Profile& across, const Profile& up,
                           float middle, float radius, Spans& out) {
    const Row d;
    const hn::RebindToSigned<Row> di;
    const auto radius2 = hn::Set(d, radius * radius), at = hn::Set(d, middle);
    const auto zero = hn::Zero(di), count = hn::Set(di, across.count);
    const auto tile = [&](hn::Vec<Row> pixel) {
        const auto number = hn::ShiftRightSame(pixel_at(pixel), tiles.bits);
        return hn::Sub(number, hn::Set(di, across.first));
    };
    for (int i = 0; i < up.count; i += static_cast<int>(hn::Lanes(d))) {
        const auto off = hn::LoadU(d, up.nearest.data() + i);
        const auto half2 = hn::Max(hn::NegMulAdd(off, off, radius2), hn::Zero(d));
        const auto half = hn::Add(hn::Sqrt(half2), hn::Set(d, kToSample));
        const auto first = tile(hn::Sub(at, half));
        const auto end = hn::Add(tile(hn::Add(at, half)), hn::Set(di, 1));
        hn::StoreU(hn::Max(hn::Min(first, count), zero), di, out.first.data() + i);
        hn::StoreU(hn::Max(hn::Min(end, count), zero), di, out.end.data() + i);
    }
}

HWY_INLINE bool is_dark(const float* light, int count) {
    const Row d;
    for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
        const auto lit = hn::Ge(hn::LoadU(d, light + i), hn::Set(d, kDark));
        if (!hn::AllFalse(d, hn::And(lit, hn::FirstN(d, static_cast<std::size_t>(count - i)))))
            return false;
    }
    return true;
}

/// Reduces the light in a row of tiles by the splat's opacity.
/// @param least smaller opacities are ignored: some samples there may not be covered
HWY_INLINE void dim(float* light, const float* gaussian, int count, float of_row, float least) {
    const Row d;
    for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
        const auto opacity = hn::Mul(hn::LoadU(d, gaussian + i), hn::Set(d, of_row));
        const auto counts = hn::Ge(opacity, hn::Set(d, least));
        const auto before = hn::LoadU(d, light + i);
        hn::StoreU(hn::NegMulAdd(before, hn::IfThenElseZero(counts, opacity), before), d,
                   light + i);
    }
}

} // namespace

std::size_t find(const CellSquares& splats, float falloff, const TileNumbers& tiles,
                 CellRange range, std::uint32_t* seen) {
    Profile across, up;
    Spans spans;
    std::size_t count = 0;
    for (std::size_t n = range.first; n < range.end; ++n) {
        const float x = splats.x()[n], y = splats.y()[n];
        const float inner = splats.inner_disc()[n], reach = splats.outer_disc()[n];
        const float per_pixel2 = inner > 0.0f ? falloff / (inner * inner) : 0.0f;
        if (!make_profile(tiles, x, reach, per_pixel2, tiles.columns, across) ||
            !make_profile(tiles, y, reach, per_pixel2, tiles.rows, up)) {
            seen[count++] = static_cast<std::uint32_t>(n);
            continue;
        }
        if (across.count < 1 || up.count < 1)
            continue;
        const auto row = [&](int i) { return tiles.row(up.first + i) + across.first; };
        find_spans(tiles, across, up, x, reach, spans);
        bool hidden = true;
        for (int i = 0; i < up.count && hidden; ++i)
            hidden = is_dark(row(i) + spans.first[i], spans.end[i] - spans.first[i]);
        if (hidden)
            continue;
        seen[count++] = static_cast<std::uint32_t>(n);
        if (!(inner > kToSample))
            continue;
        const float whole = (inner - kToSample) / inner; // up to here all samples are covered
        const float least = std::exp2(falloff * whole * whole);
        for (int i = 0; i < up.count; ++i)
            if (up.gaussian[i] >= least)
                dim(row(i), across.gaussian.data(), across.count, up.gaussian[i], least);
    }
    return count;
}

} // namespace isochron::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::render {

HWY_EXPORT(find);

std::size_t find_splats(const CellSquares& splats, float falloff, const TileNumbers& tiles,
                        CellRange range, std::uint32_t* seen) {
    return HWY_DYNAMIC_DISPATCH(find)(splats, falloff, tiles, range, seen);
}

} // namespace isochron::render
#endif
