// Projects cells as the vertex shader does; compiled for each SIMD target, chosen at run time.
#include "render/culling/cell_squares.h"

#include "render/cells/point_sprites.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/culling/cell_squares.cpp"
#include <hwy/foreach_target.h> // must come before highway.h

#include "render/culling/cut_stripes_inl.h"
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace isochron::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

static_assert(kMostAtOnce <= CellSquares::kBlock);

/// As in cell.vert: an ellipse with half axes a, b has an upright quad if
/// (a^2 - b^2) / (a^2 + b^2) is at most this.
constexpr float kRound = 0.1f;
/// Like kLeastDepth, but for an eye two radii away: splats farther away do not fade.
constexpr float kWholeDepth = 0.75f;

/// Spheres of one radius, in voxels.
template <class Sides>
struct Spheres {
    Sides sides;
    V radius2;
    HWY_INLINE V form(const V3& u, const V3& v) const {
        return hn::Mul(radius2, dot(sides.in_form(u), sides.in_form(v)));
    }
};

/// As ellipse.glsl has it: `Footprint` and `form`.
template <class Sides>
struct Ellipsoids {
    Sides sides;
    V3 normal, lengthwise;
    V across2, normal2, lengthwise2; ///< square half axes; the last two minus the first
    HWY_INLINE V form(const V3& u_even, const V3& v_even) const {
        const V3 u = sides.in_form(u_even), v = sides.in_form(v_even);
        const V flat = hn::Mul(normal2, hn::Mul(dot(u, normal), dot(v, normal)));
        const V length = hn::Mul(lengthwise2, hn::Mul(dot(u, lengthwise), dot(v, lengthwise)));
        return hn::MulAdd(across2, dot(u, v), hn::Add(flat, length));
    }
};

/// The ellipsoids on the planes of the next cells.
/// @param cells their centers are moved to the centers of the ellipsoids
template <class Sides>
HWY_INLINE Ellipsoids<Sides> ellipsoids(const SquareProjection& p, const std::uint32_t* words,
                                        Boxes<Sides>& cells) {
    const Floats d;
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const Planes planes = planes_in(p, words, cells.sides);
    move_to(planes, cells);
    const V3 &size = planes.size, &normal = planes.normal, any{zero, zero, one};
    const V lower = hn::Min(size.x, size.y), upper = hn::Max(size.x, size.y);
    const V least = hn::Min(lower, size.z), median = hn::Max(lower, hn::Min(upper, size.z));
    const auto x_is = hn::Eq(size.x, least), y_is = hn::Eq(size.y, least);
    const V3 edge = select(x_is, {one, zero, zero}, select(y_is, {zero, one, zero}, any));
    const V lean = dot(edge, normal);
    const V3 lengthwise =
        over_length({hn::NegMulAdd(lean, normal.x, edge.x), hn::NegMulAdd(lean, normal.y, edge.y),
                     hn::NegMulAdd(lean, normal.z, edge.z)});
    const auto square = [&](V half_axis) HWY_ATTR {
        const V length = hn::Mul(cells.sides.half_axes(p.radius),
                                 hn::IfThenElse(planes.are_there, half_axis, one));
        return hn::Mul(length, length);
    };
    const auto clamped = [&](V length) {
        return hn::Clamp(length, hn::Set(d, SplatShape::kLeastWidth), one);
    };
    const V across2 = square(clamped(hn::Div(planes.rest, median)));
    const V length2 =
        square(clamped(hn::Div(hn::Mul(planes.rest, hn::Set(d, SplatShape::kLengthwise)), least)));
    const V thickness2 = square(hn::Set(d, SplatShape::kThickness));
    return {cells.sides,
            normal,
            lengthwise,
            across2,
            hn::Sub(thickness2, across2),
            hn::Sub(length2, across2)};
}

/// @tparam Shape of the cells, with a function `form`
template <class Shape, class Sides>
HWY_INLINE void project_shape(const SquareProjection& p, const Shape& cells,
                              const Boxes<Sides>& boxes, std::size_t i, const SquareArrays& out) {
    const Floats d;
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), two = hn::Set(d, 2.0f);
    const V3& center = boxes.center;
    const V radius = hn::Mul(hn::Set(d, p.radius), boxes.sides.largest());
    const float tilt2 = glm::dot(glm::vec3(p.row_w), glm::vec3(p.row_w));
    const V3 row_w = set(p.row_w);
    const V w = at(p.row_w, center);
    const V depth = hn::Sub(hn::Mul(w, w), cells.form(row_w, row_w));
    const auto is_near =
        hn::Or(hn::Le(w, zero), hn::Le(depth, hn::Mul(hn::Set(d, kLeastDepth), hn::Mul(w, w))));
    const auto behind = hn::Lt(w, hn::Mul(hn::Set(d, -1.01f * std::sqrt(tilt2)), radius));

    const V over_w = hn::Div(one, w);
    const V x = hn::Mul(at(p.row_x, center), over_w), y = hn::Mul(at(p.row_y, center), over_w);
    const V z = hn::Mul(at(p.row_z, center), over_w);
    const auto off = [&](const glm::vec4& row, V along) {
        const V3 all = set(row);
        return V3{hn::NegMulAdd(along, row_w.x, all.x), hn::NegMulAdd(along, row_w.y, all.y),
                  hn::NegMulAdd(along, row_w.z, all.z)};
    };
    const V3 a = off(p.row_x, x), b = off(p.row_y, y);
    const V k = hn::Div(one, depth);
    const V shift_x = hn::Neg(hn::Mul(k, cells.form(a, row_w)));
    const V shift_y = hn::Neg(hn::Mul(k, cells.form(b, row_w)));
    const V xx = hn::MulAdd(shift_x, shift_x, hn::Mul(k, cells.form(a, a)));
    const V xy = hn::MulAdd(shift_x, shift_y, hn::Mul(k, cells.form(a, b)));
    const V yy = hn::MulAdd(shift_y, shift_y, hn::Mul(k, cells.form(b, b)));
    // The quad of a nearly round ellipse with shape s is the image of a square under the symmetric
    // root of s, which is (s + sqrt(det s)) / sqrt(trace s + 2 sqrt(det s)).
    const V det = hn::Sqrt(hn::Max(hn::NegMulAdd(xy, xy, hn::Mul(xx, yy)), zero));
    const V trace = hn::Add(xx, yy), apart = hn::Sub(xx, yy);
    const V most = hn::Div(hn::Add(hn::Max(xx, yy), hn::Add(det, hn::Abs(xy))),
                           hn::Sqrt(hn::MulAdd(two, det, trace)));
    // a^2 - b^2 of its half axes; `trace` is a^2 + b^2.
    const V uneven = hn::Sqrt(hn::MulAdd(apart, apart, hn::Mul(hn::Set(d, 4.0f), hn::Mul(xy, xy))));
    const auto round = hn::Lt(uneven, hn::Mul(hn::Set(d, kRound), trace));
    const auto hides = hn::And(round, hn::Lt(hn::Abs(z), hn::Set(d, kClipped)));
    const V inner = hn::IfThenElseZero(hides, hn::Div(det, most));
    const V outer = hn::IfThenElse(round, most, hn::Sqrt(hn::Add(trace, uneven)));

    const V major = hn::Sqrt(hn::Mul(hn::Set(d, 0.5f), hn::Add(trace, uneven)));
    const V from_sphere = hn::NegMulAdd(hn::Mul(radius, radius), hn::Set(d, tilt2), hn::Mul(w, w));
    const auto whole =
        hn::And(hn::Lt(hn::Abs(z), hn::Set(d, kClipped)),
                hn::Ge(from_sphere, hn::Mul(hn::Set(d, kWholeDepth), hn::Mul(w, w))));

    const V far = hn::Set(d, kFar);
    const V everywhere = hn::IfThenZeroElse(behind, hn::Set(d, 2.0f * kFar));
    const auto store = [&](V of_near, V of_others, float* to) {
        hn::StoreU(hn::IfThenElse(is_near, of_near, of_others), d, to + i);
    };
    store(far, hn::Add(hn::Set(d, p.middle.x), hn::Add(x, shift_x)), out.x);
    store(far, hn::Add(hn::Set(d, p.middle.y), hn::Add(y, shift_y)), out.y);
    store(hn::Neg(far), z, out.z);
    store(zero, inner, out.inner);
    store(everywhere, outer, out.outer);
    store(zero, hn::IfThenElseZero(whole, hn::Div(det, major)), out.inner_disc);
    store(everywhere, major, out.outer_disc);
}

/// Projects the next cells and stores the results from index `i` of the arrays.
/// @param planes null if the cells are spheres
template <CellKind kKind>
HWY_INLINE void project_next(const SquareProjection& p, const std::uint32_t* words,
                             const std::uint32_t* planes, std::size_t i, const SquareArrays& out) {
    auto cells = boxes<kKind>(p, words);
    if (out.low) {
        project_cuts(p, planes, cells, i, out);
    } else if (planes) {
        const auto shape = ellipsoids(p, planes, cells);
        project_shape(p, shape, cells, i, out);
    } else {
        const V radius = cells.sides.half_axes(p.radius);
        const Spheres<decltype(cells.sides)> shape{cells.sides, hn::Mul(radius, radius)};
        project_shape(p, shape, cells, i, out);
    }
}

template <CellKind kKind>
HWY_INLINE void project_all(const SquareProjection& p, const std::uint32_t* words,
                            const std::uint32_t* planes, std::size_t cells,
                            const SquareArrays& out) {
    for (std::size_t i = 0; i < cells; i += hn::Lanes(Floats()))
        project_next<kKind>(p, words + 2 * i, planes ? planes + i : nullptr, i, out);
}

} // namespace

void project(const SquareProjection& projection, const std::uint32_t* words,
             const std::uint32_t* planes, std::size_t cells, CellKind kind,
             const SquareArrays& out) {
    switch (kind) {
    case CellKind::even: return project_all<CellKind::even>(projection, words, planes, cells, out);
    case CellKind::mixed:
        return project_all<CellKind::mixed>(projection, words, planes, cells, out);
    case CellKind::uneven:
        return project_all<CellKind::uneven>(projection, words, planes, cells, out);
    case CellKind::mixed_uneven:
        return project_all<CellKind::mixed_uneven>(projection, words, planes, cells, out);
    }
}

} // namespace isochron::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::render {

HWY_EXPORT(project);

void CellSquares::take_axes(const Placement& placement) {
    if (grid_ == placement.rectilinear)
        return;
    grid_ = placement.rectilinear;
    axes_ = grid_ ? axis_places(*grid_) : std::array<AxisPlaces, 3>();
}

void CellSquares::begin(const View& view, const Placement& placement, const SplatShape& shape,
                        const Slots& slots) {
    const bool on_planes = shape.shape == CellShape::plane;
    size_ = slots.places.size();
    done_ = 0;
    const std::size_t whole = (size_ + kBlock - 1) / kBlock * kBlock;
    take_axes(placement);
    words_.resize(2 * whole);
    std::fill(words_.begin() + static_cast<std::ptrdiff_t>(2 * size_), words_.end(), 0u);
    planes_.resize(on_planes ? whole : 0);
    for (std::vector<float>* array : {&x_, &y_, &z_, &inner_, &inner_disc_})
        array->resize(whole);
    for (std::vector<float>* array : {&outer_, &outer_disc_})
        array->resize(shape.is_cut() ? 0 : whole);
    for (std::vector<float>* array : {&low_, &high_})
        array->resize(shape.is_cut() ? whole : 0);
    for (auto& axis : stripes_)
        for (std::vector<float>& array : axis)
            array.resize(low_.size());
    const glm::vec2 half_size = 0.5f * glm::vec2(view.size);
    const glm::mat4 rows =
        glm::transpose(view.clip_from_eye * view.eye_from_room * placement.room_from_index);
    projection_ = {half_size.x * rows[0],
                   half_size.y * rows[1],
                   rows[2],
                   rows[3],
                   half_size,
                   shape.radius,
                   placement.index_from_normal(),
                   placement.extent,
                   {},
                   {},
                   {}};
    for (std::size_t axis = 0; grid_ && axis < axes_.size(); ++axis) {
        projection_.places[axis] = axes_[axis].place.data();
        projection_.sides[axis] = axes_[axis].side.data();
        projection_.last[axis] = static_cast<std::int32_t>(axes_[axis].place.size()) - 1;
    }
    if (slots.largest > 0) // the cells are of mixed levels
        kind_ = grid_ ? CellKind::mixed_uneven : CellKind::mixed;
    else
        kind_ = grid_ ? CellKind::uneven : CellKind::even;
}

void CellSquares::project_to(std::size_t to, const Slots& slots,
                             std::span<const std::uint32_t> back_to_front) {
    to = std::min((to + kBlock - 1) / kBlock * kBlock, words_.size() / 2);
    if (to <= done_)
        return;
    for (std::size_t i = done_; i < std::min(to, size_); ++i) {
        const std::uint32_t slot = back_to_front[size_ - 1 - i];
        std::memcpy(&words_[2 * i], &slots.places[slot], sizeof(CellPlace));
        if (!planes_.empty())
            planes_[i] = slots.planes[slot];
    }
    const auto from = [&](std::vector<float>& array) {
        return array.empty() ? nullptr : array.data() + done_;
    };
    SquareArrays arrays{
        from(x_),          from(y_),          from(z_),   from(inner_), from(outer_),
        from(inner_disc_), from(outer_disc_), from(low_), from(high_),  {}};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t what = 0; what < 3; ++what)
            arrays.stripes[axis][what] = from(stripes_[axis][what]);
    HWY_DYNAMIC_DISPATCH(project)
    (projection_, &words_[2 * done_], planes_.empty() ? nullptr : &planes_[done_], to - done_,
     kind_, arrays);
    done_ = to;
}

} // namespace isochron::render
#endif
