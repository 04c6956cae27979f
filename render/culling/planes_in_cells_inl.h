// Planes of the surface in many cells at a time; compiled once for each SIMD target.
#include "index/surface/cell_plane.h"
#include "render/cells/cell_shape.h"
#include "render/culling/cell_boxes_inl.h"
#include "render/culling/square_projection.h"

#include <hwy/highway.h>

#include <glm/vec3.hpp>

#include <cstdint>

// Highway's guard: the file is read again for every target.
#if defined(ISOCHRON_RENDER_PLANES_IN_CELLS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ISOCHRON_RENDER_PLANES_IN_CELLS_INL_H
#undef ISOCHRON_RENDER_PLANES_IN_CELLS_INL_H
#else
#define ISOCHRON_RENDER_PLANES_IN_CELLS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace isochron::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Mask = hn::Mask<Floats>;

HWY_INLINE V3 cross(const V3& a, const V3& b) {
    return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
            hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}

HWY_INLINE V3 over_length(const V3& v) {
    const V to_one = hn::Div(hn::Set(Floats(), 1.0f), hn::Sqrt(dot(v, v)));
    return {hn::Mul(v.x, to_one), hn::Mul(v.y, to_one), hn::Mul(v.z, to_one)};
}

HWY_INLINE V3 select(Mask which, const V3& yes, const V3& no) {
    return {hn::IfThenElse(which, yes.x, no.x), hn::IfThenElse(which, yes.y, no.y),
            hn::IfThenElse(which, yes.z, no.z)};
}

/// Planes of several cells at a time; plane.glsl has the same for one.
struct Planes {
    Mask are_there; ///< cells with a plane
    V3 normal;      ///< (0, 0, 1) if there is none
    V3 size;        ///< absolute values of the normal's components, a little above 0
    V3 middle;      ///< from the cell's [voxels]; zero if there is none
    V rest;
};

/// The planes of the next cells.
template <class Sides>
HWY_INLINE Planes planes_in(const SquareProjection& p, const std::uint32_t* words,
                            const Sides& sides) {
    const Floats d;
    const hn::RebindToUnsigned<Floats> du;
    const hn::RebindToSigned<Floats> di;
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f);
    const auto word = hn::LoadU(du, words);
    const auto coordinate = [&](hn::Vec<decltype(du)> bits) HWY_ATTR {
        const auto number = hn::BitCast(di, hn::And(bits, hn::Set(du, 0xfffu)));
        const V steps = hn::ConvertTo(d, hn::Sub(number, hn::Set(di, index::packed_plane::kZero)));
        return hn::Mul(steps, hn::Set(d, 1.0f / index::packed_plane::kOne));
    };
    V3 n{coordinate(word), coordinate(hn::ShiftRight<12>(word)), one};
    n.z = hn::Sub(one, hn::Add(hn::Abs(n.x), hn::Abs(n.y)));
    const V fold = hn::Max(hn::Neg(n.z), zero);
    n.x = hn::Sub(n.x, hn::CopySign(fold, n.x));
    n.y = hn::Sub(n.y, hn::CopySign(fold, n.y));
    const auto row = [&](int i) {
        const glm::vec3 r(p.index_from_normal[0][i], p.index_from_normal[1][i],
                          p.index_from_normal[2][i]);
        return dot({hn::Set(d, r.x), hn::Set(d, r.y), hn::Set(d, r.z)}, n);
    };
    const V3 in_index = sides.in_form({row(0), row(1), row(2)});
    const auto flat_bits = hn::Ne(hn::And(word, hn::Set(du, index::kNormalBits)), hn::Zero(du));
    const auto is_flat =
        hn::And(hn::RebindMask(d, flat_bits), hn::Gt(dot(in_index, in_index), zero));
    const V3 any{zero, zero, one};
    const V3 normal = over_length(select(is_flat, in_index, any));
    constexpr float kStep = float(index::CellPlane::kFarthest / index::packed_plane::kFarthest);
    const auto byte = hn::ShiftRight<24>(hn::BitCast(di, word));
    const V offset = hn::Mul(hn::ConvertTo(d, byte), hn::Set(d, kStep));

    const V tiny = hn::Set(d, 1e-6f);
    const V3 size{hn::Max(hn::Abs(normal.x), tiny), hn::Max(hn::Abs(normal.y), tiny),
                  hn::Max(hn::Abs(normal.z), tiny)};
    const V sum = hn::Add(size.x, hn::Add(size.y, size.z));
    const V rest =
        hn::Max(hn::MulSub(half, sum, hn::Abs(offset)), hn::Set(d, SplatShape::kLeastRest));
    const auto towards = [&](V of_size, V of_normal) HWY_ATTR {
        const V third = hn::Div(rest, hn::Mul(hn::Set(d, 3.0f), of_size));
        const V outwards = hn::Sub(half, hn::Min(third, half));
        return hn::CopySign(outwards, hn::Xor(of_normal, offset));
    };
    V3 at{towards(size.x, normal.x), towards(size.y, normal.y), towards(size.z, normal.z)};
    const V back = hn::Sub(offset, dot(normal, at));
    at = {hn::MulAdd(back, normal.x, at.x), hn::MulAdd(back, normal.y, at.y),
          hn::MulAdd(back, normal.z, at.z)};
    return {is_flat, normal, size, select(is_flat, at, {zero, zero, zero}), rest};
}

/// Moves the cells' centers to the middles of their planes.
template <class Sides>
HWY_INLINE void move_to(const Planes& planes, Boxes<Sides>& cells) {
    const V3 shift = cells.sides.stretched(planes.middle);
    V3& center = cells.center;
    center = {hn::Add(center.x, shift.x), hn::Add(center.y, shift.y), hn::Add(center.z, shift.z)};
}

} // namespace
} // namespace isochron::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
