// Tests and covers tiles, a row at a time; compiled once for each SIMD target.
#include "render/culling/cell_squares.h"
#include "render/culling/picture_tiles.h"

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>

// Highway's guard: the file is read again for every target.
#if defined(ISOCHRON_RENDER_TILE_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ISOCHRON_RENDER_TILE_ROWS_INL_H
#undef ISOCHRON_RENDER_TILE_ROWS_INL_H
#else
#define ISOCHRON_RENDER_TILE_ROWS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace isochron::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Least difference of clip depths at which the nearer quad hides the other: GL rounds depths
/// differently.
constexpr float kLevel = 1e-6f;

using BlockFloats = hn::CappedTag<float, CellSquares::kBlock>;
using BlockInts = hn::RebindToSigned<BlockFloats>;
using Row = hn::CappedTag<float, TileNumbers::kSlack>;

/// Inclusive ranges of tiles along one axis for a block of cells; empty if `last` < `first`.
struct Tiles {
    std::array<std::int32_t, CellSquares::kBlock> first, last;
};

constexpr float kFarthest = 65536.0f; ///< [pixel] beyond any view

/// The pixels at some places; places far outside any view are clamped.
template <class V>
HWY_INLINE hn::Vec<hn::RebindToSigned<hn::DFromV<V>>> pixel_at(V at) {
    const hn::DFromV<V> d;
    const auto near = hn::Clamp(at, hn::Set(d, -kFarthest), hn::Set(d, kFarthest));
    return hn::ConvertTo(hn::RebindToSigned<hn::DFromV<V>>(), hn::Floor(near));
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

HWY_INLINE void cover_row(float* row, int first, int last, float z) {
    const Row d;
    all_of_row(row, first, last, [&](float* at, auto which) {
        const auto before = hn::LoadU(d, at);
        hn::StoreU(hn::IfThenElse(which, hn::Min(before, hn::Set(d, z)), before), d, at);
        return true;
    });
}

} // namespace
} // namespace isochron::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
