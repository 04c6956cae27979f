// Projects the parts of planes in cells, many at a time; compiled once for each SIMD target.
#include "render/culling/planes_in_cells_inl.h"

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

// Highway's guard: the file is read again for every target.
#if defined(ISOCHRON_RENDER_CUT_STRIPES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ISOCHRON_RENDER_CUT_STRIPES_INL_H
#undef ISOCHRON_RENDER_CUT_STRIPES_INL_H
#else
#define ISOCHRON_RENDER_CUT_STRIPES_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace isochron::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// `Stripes` of cut.glsl, in the picture.
struct CutStripes {
    V3 start, right, up;
};

HWY_INLINE V3 abs(const V3& v) {
    return {hn::Abs(v.x), hn::Abs(v.y), hn::Abs(v.z)};
}

/// @param a, b per voxel: changes of the picture's place, times w
HWY_INLINE CutStripes stripes_of(const SquareProjection& p, const Planes& planes, const V3& a,
                                 const V3& b, V w) {
    const Floats d;
    const V zero = hn::Zero(d);
    const V3 ahead = cross(a, b);
    const V3 none{zero, zero, zero};
    V3 n = select(planes.are_there, planes.normal, none);
    const V ahead2 = dot(ahead, ahead), facing = dot(n, ahead);
    const V least = hn::Mul(hn::Set(d, SplatShape::kLeastCosine), hn::Sqrt(ahead2));
    const V enough = hn::IfThenElse(hn::Lt(facing, zero), hn::Neg(least), least);
    const auto edge_on = hn::Lt(hn::Abs(facing), least);
    const V turn = hn::IfThenElseZero(edge_on, hn::Div(hn::Sub(enough, facing), ahead2));
    n = {hn::MulAdd(turn, ahead.x, n.x), hn::MulAdd(turn, ahead.y, n.y),
         hn::MulAdd(turn, ahead.z, n.z)};
    const V per_half = hn::Set(d, 1.0f / p.radius);
    const V share = hn::Div(hn::Mul(per_half, w), hn::IfThenElse(edge_on, enough, facing));
    const auto times = [](const V3& v, V by) HWY_ATTR { return scaled(v, {by, by, by}); };
    return {times(planes.middle, per_half), times(cross(b, n), share), times(cross(n, a), share)};
}

/// Projects the next cells and stores the results from index `i` of the arrays.
template <class Sides>
HWY_INLINE void project_cuts(const SquareProjection& p, const std::uint32_t* words,
                             Boxes<Sides> cells, std::size_t i, const SquareArrays& out) {
    const Floats d;
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), far = hn::Set(d, kFar);
    const Planes planes = planes_in(p, words, cells.sides);
    move_to(planes, cells);
    const V w = at(p.row_w, cells.center), over_w = hn::Div(one, w);
    const V x = hn::Mul(at(p.row_x, cells.center), over_w);
    const V y = hn::Mul(at(p.row_y, cells.center), over_w);
    const V z = hn::Mul(at(p.row_z, cells.center), over_w);
    const V3 row_w = cells.sides.stretched(set(p.row_w));
    const auto off = [&](const glm::vec4& row, V along) HWY_ATTR {
        const V3 all = cells.sides.stretched(set(row));
        return V3{hn::NegMulAdd(along, row_w.x, all.x), hn::NegMulAdd(along, row_w.y, all.y),
                  hn::NegMulAdd(along, row_w.z, all.z)};
    };
    const CutStripes stripes = stripes_of(p, planes, off(p.row_x, x), off(p.row_y, y), w);

    const V3 about = abs(row_w);
    const V reach =
        hn::Mul(hn::Set(d, SplatShape::kNearEye), hn::Add(about.x, hn::Add(about.y, about.z)));
    const auto is_near = hn::Not(hn::Gt(w, reach));
    // Near the eye, what may be in the view is taken to be everywhere.
    auto outside = hn::Lt(w, hn::Neg(reach));
    const auto beyond = [&](const glm::vec4& row, float size) HWY_ATTR {
        const glm::vec4 plane = row + size * p.row_w; // an edge of the view, positive inside
        const V3 all = abs(cells.sides.stretched(set(plane)));
        const V most =
            hn::Mul(hn::Set(d, SplatShape::kNearEye), hn::Add(all.x, hn::Add(all.y, all.z)));
        outside = hn::Or(outside, hn::Lt(at(plane, cells.center), hn::Neg(most)));
    };
    beyond(p.row_x, p.middle.x);
    beyond(-p.row_x, p.middle.x);
    beyond(p.row_y, p.middle.y);
    beyond(-p.row_y, p.middle.y);
    const V everywhere = hn::IfThenZeroElse(outside, hn::Set(d, 4.0f * kFar));
    const auto store = [&](V of_near, V of_others, float* to) HWY_ATTR {
        hn::StoreU(hn::IfThenElse(is_near, of_near, of_others), d, to + i);
    };
    const V middle_y = hn::Add(hn::Set(d, p.middle.y), y);
    store(far, hn::Add(hn::Set(d, p.middle.x), x), out.x);
    store(far, middle_y, out.y);
    store(hn::Neg(far), z, out.z);
    store(zero, hn::IfThenElseZero(hn::Lt(hn::Abs(z), hn::Set(d, kClipped)), one), out.inner);

    // The rows of the parallelograms in which two stripes cross, for each two of the three; two
    // that are parallel bound nothing.
    const V3 crossing = cross(stripes.right, stripes.up);
    const V3 right = abs(stripes.right), up = abs(stripes.up);
    const V3 at_y = cross(stripes.start, stripes.right);
    V lowest = hn::Neg(far), highest = far, area = far;
    const auto bound = [&](V det, V y_times_det, V right_i, V up_i, V right_j, V up_j) HWY_ATTR {
        const V products = hn::MulAdd(right_i, up_j, hn::Mul(right_j, up_i));
        const auto cross_each_other =
            hn::Gt(hn::Abs(det), hn::Mul(hn::Set(d, SplatShape::kParallel), products));
        const V share = hn::Div(one, det), middle = hn::Mul(share, y_times_det);
        const V half = hn::Mul(hn::Abs(share), hn::Add(right_i, right_j));
        const auto unless_parallel = [&](V value, V otherwise) HWY_ATTR {
            return hn::IfThenElse(cross_each_other, value, otherwise);
        };
        lowest = unless_parallel(hn::Max(lowest, hn::Sub(middle, half)), lowest);
        highest = unless_parallel(hn::Min(highest, hn::Add(middle, half)), highest);
        area = unless_parallel(hn::Min(area, hn::Abs(share)), area);
    };
    bound(crossing.x, at_y.x, right.y, up.y, right.z, up.z);
    bound(crossing.y, at_y.y, right.z, up.z, right.x, up.x);
    bound(crossing.z, at_y.z, right.x, up.x, right.y, up.y);
    store(hn::Neg(everywhere), hn::Add(middle_y, lowest), out.low);
    store(everywhere, hn::Add(middle_y, highest), out.high);
    store(zero, hn::Sqrt(area), out.inner_disc);

    const auto write = [&](int axis, V start, V to_right, V to_up) HWY_ATTR {
        const V steep = hn::CopySign(hn::Max(hn::Abs(to_right), hn::Set(d, 1e-9f)), to_right);
        const V pixels = hn::Div(one, steep);
        float* const* const to = out.stripes[axis];
        store(zero, hn::Neg(hn::Mul(start, pixels)), to[0]);
        store(zero, hn::Neg(hn::Mul(to_up, pixels)), to[1]);
        store(hn::Set(d, 8.0f * kFar), hn::Abs(pixels), to[2]);
    };
    write(0, stripes.start.x, stripes.right.x, stripes.up.x);
    write(1, stripes.start.y, stripes.right.y, stripes.up.y);
    write(2, stripes.start.z, stripes.right.z, stripes.up.z);
}

} // namespace
} // namespace isochron::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
