// Places of many cells at a time, on regular and rectilinear grids; compiled once for each SIMD
// target.
#include "render/culling/square_projection.h"

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

// Highway's guard: the file is read again for every target.
#if defined(ISOCHRON_RENDER_CELL_BOXES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ISOCHRON_RENDER_CELL_BOXES_INL_H
#undef ISOCHRON_RENDER_CELL_BOXES_INL_H
#else
#define ISOCHRON_RENDER_CELL_BOXES_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace isochron::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kMostAtOnce = 16;
using Floats = hn::CappedTag<float, kMostAtOnce>;
using V = hn::Vec<Floats>;

struct V3 {
    V x, y, z;
};

HWY_INLINE V dot(const V3& a, const V3& b) {
    return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}

HWY_INLINE V3 set(const glm::vec4& row) {
    const Floats d;
    return {hn::Set(d, row.x), hn::Set(d, row.y), hn::Set(d, row.z)};
}

HWY_INLINE V at(const glm::vec4& row, const V3& center) {
    return hn::Add(dot(set(row), center), hn::Set(Floats(), row.w));
}

HWY_INLINE V3 scaled(const V3& v, const V3& by) {
    return {hn::Mul(v.x, by.x), hn::Mul(v.y, by.y), hn::Mul(v.z, by.z)};
}

/// Sides of the boxes of a regular grid: one size for all axes.
struct EvenSides {
    V size;
    HWY_INLINE V largest() const { return size; }
    /// From voxels to even coordinates.
    HWY_INLINE V3 stretched(const V3& v) const { return scaled(v, {size, size, size}); }
    /// Half axes of a shape of this radius; then a vector in the units of these half axes.
    HWY_INLINE V half_axes(float radius) const { return hn::Mul(hn::Set(Floats(), radius), size); }
    HWY_INLINE V3 in_form(const V3& v) const { return v; }
    /// From results in the units of `in_form` to voxels.
    HWY_INLINE V3 in_voxels(const V3& v) const {
        const V share = hn::Div(hn::Set(Floats(), 1.0f), size);
        return scaled(v, {share, share, share});
    }
};

/// Sides of the boxes of a rectilinear grid: half axes are in voxels.
struct UnevenSides {
    V3 size;
    HWY_INLINE V largest() const { return hn::Max(size.x, hn::Max(size.y, size.z)); }
    HWY_INLINE V3 stretched(const V3& v) const { return scaled(v, size); }
    HWY_INLINE V half_axes(float radius) const { return hn::Set(Floats(), radius); }
    HWY_INLINE V3 in_form(const V3& v) const { return scaled(v, size); }
    HWY_INLINE V3 in_voxels(const V3& v) const { return v; }
};

/// Boxes of cells, as in cell_box.glsl.
template <class Sides>
struct Boxes {
    V3 center;
    Sides sides;
};

/// The next cells of a rectilinear grid, from their coordinates.
/// @tparam kMixed the cells are of mixed levels of detail
template <bool kMixed>
HWY_INLINE Boxes<UnevenSides> uneven_boxes(const SquareProjection& p,
                                           const hn::Vec<hn::RebindToSigned<Floats>> (&cell)[3]) {
    const Floats d;
    const hn::RebindToSigned<Floats> di;
    const V half = hn::Set(d, 0.5f);
    const auto voxels = hn::And(cell[0], hn::Neg(cell[0]));
    V center[3], size[3];
    for (int axis = 0; axis < 3; ++axis) {
        const auto last = hn::Set(di, p.last[axis]);
        const auto place = [&](hn::Vec<decltype(di)> vertex)
                               HWY_ATTR { return hn::GatherIndex(d, p.places[axis], vertex); };
        if constexpr (kMixed) {
            const auto low = hn::Min(hn::ShiftRight<1>(hn::Sub(cell[axis], voxels)), last);
            const V first = place(low), end = place(hn::Min(hn::Add(low, voxels), last));
            center[axis] = hn::Mul(half, hn::Add(first, end));
            size[axis] = hn::Sub(end, first);
        } else {
            const auto low = hn::Min(cell[axis], last);
            size[axis] = hn::GatherIndex(d, p.sides[axis], low);
            center[axis] = hn::MulAdd(half, size[axis], place(low));
        }
    }
    return {{center[0], center[1], center[2]}, {{size[0], size[1], size[2]}}};
}

/// The next cells, from their words.
template <CellKind kKind>
HWY_INLINE auto boxes(const SquareProjection& p, const std::uint32_t* words) {
    const Floats d;
    const hn::RebindToUnsigned<Floats> du;
    const hn::RebindToSigned<Floats> di;
    hn::Vec<decltype(du)> xy, z_style;
    hn::LoadInterleaved2(du, words, xy, z_style);
    const auto low = hn::Set(du, 0xffffu);
    const V half = hn::Set(d, 0.5f), one = hn::Set(d, 1.0f);
    const auto number = [&](hn::Vec<decltype(du)> cell) {
        return hn::ConvertTo(d, hn::BitCast(di, cell));
    };
    const auto x = hn::And(xy, low), y = hn::ShiftRight<16>(xy), z = hn::And(z_style, low);
    if constexpr (kKind == CellKind::uneven || kKind == CellKind::mixed_uneven) {
        const hn::Vec<decltype(di)> cell[3] = {hn::BitCast(di, x), hn::BitCast(di, y),
                                               hn::BitCast(di, z)};
        constexpr bool kMixed = kKind == CellKind::mixed_uneven;
        return uneven_boxes<kMixed>(p, cell);
    } else if constexpr (kKind == CellKind::even) {
        const auto middle = [&](hn::Vec<decltype(du)> cell) { return hn::Add(number(cell), half); };
        return Boxes<EvenSides>{{middle(x), middle(y), middle(z)}, {one}};
    } else {
        const auto of_x = hn::BitCast(di, x);
        const V size = hn::ConvertTo(d, hn::And(of_x, hn::Neg(of_x)));
        const auto middle = [&](hn::Vec<decltype(du)> doubled, float end) {
            const V start = hn::Mul(half, hn::Sub(number(doubled), size));
            return hn::Mul(half, hn::Add(start, hn::Min(hn::Add(start, size), hn::Set(d, end))));
        };
        return Boxes<EvenSides>{
            {middle(x, p.extent.x), middle(y, p.extent.y), middle(z, p.extent.z)}, {size}};
    }
}

} // namespace
} // namespace isochron::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
