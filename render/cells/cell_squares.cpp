// Projects cells as the vertex shader does; compiled for each SIMD target, chosen at run time.
#include "render/cells/cell_squares.h"

#include "index/extraction/cell_plane.h"
#include "render/cells/point_sprites.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cells/cell_squares.cpp"
#include <hwy/foreach_target.h> // must come before highway.h

#include "render/cells/cell_boxes_inl.h"
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace isochron::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

static_assert(kMostAtOnce <= CellSquares::kBlock);

/// As in cell.vert: an ellipse with half axes a, b has an upright quad if
/// (a^2 - b^2) / (a^2 + b^2) is at most this.
constexpr float kRound = 0.1f;
constexpr float kClipped =
    1.0f - 1e-6f; ///< cells at a larger |z| may be clipped: they hide nothing
/// Like kLeastDepth, but for an eye two radii away: splats farther away do not fade.
constexpr float kWholeDepth = 0.75f;
constexpr float kFar = 1e9f; ///< beyond any view and before any depth

/// Spheres of one radius, in voxels.
template <class Sides>
struct Spheres {
    Sides sides;
    V radius2;
    HWY_INLINE V form(const V3& u, const V3& v) const {
        return hn::Mul(radius2, dot(sides.in_form(u), sides.in_form(v)));
    }
};

/// As plane.glsl has it: `Splat` and `form`.
template <class Sides>
struct Ellipsoids {
    Sides sides;
    V3 in_cell; ///< the middle, from the cell's [voxels]
    V3 normal, lengthwise;
    V across2, normal2, lengthwise2; ///< square half axes; the last two minus the first
    HWY_INLINE V form(const V3& u_even, const V3& v_even) const {
        const V3 u = sides.in_form(u_even), v = sides.in_form(v_even);
        const V flat = hn::Mul(normal2, hn::Mul(dot(u, normal), dot(v, normal)));
        const V length = hn::Mul(lengthwise2, hn::Mul(dot(u, lengthwise), dot(v, lengthwise)));
        return hn::MulAdd(across2, dot(u, v), hn::Add(flat, length));
    }
    /// [voxels]
    HWY_INLINE V3 spread(const V3& u_even) const {
        const V3 u = sides.in_form(u_even);
        const V flat = hn::Mul(normal2, dot(u, normal));
        const V length = hn::Mul(lengthwise2, dot(u, lengthwise));
        const auto along = [&](V of_u, V of_normal, V of_length) HWY_ATTR {
            return hn::MulAdd(across2, of_u,
                              hn::MulAdd(flat, of_normal, hn::Mul(length, of_length)));
        };
        return sides.in_voxels({along(u.x, normal.x, lengthwise.x),
                                along(u.y, normal.y, lengthwise.y),
                                along(u.z, normal.z, lengthwise.z)});
    }
};

HWY_INLINE V3 over_length(const V3& v) {
    const V to_one = hn::Div(hn::Set(Floats(), 1.0f), hn::Sqrt(dot(v, v)));
    return {hn::Mul(v.x, to_one), hn::Mul(v.y, to_one), hn::Mul(v.z, to_one)};
}

template <class M>
HWY_INLINE V3 select(M which, const V3& yes, const V3& no) {
    return {hn::IfThenElse(which, yes.x, no.x), hn::IfThenElse(which, yes.y, no.y),
            hn::IfThenElse(which, yes.z, no.z)};
}

/// The ellipsoids on the planes of the next cells.
/// @param cells their centers become those of the ellipsoids
template <class Sides>
HWY_INLINE Ellipsoids<Sides> ellipsoids(const SquareProjection& p, const std::uint32_t* words,
                                        Boxes<Sides>& cells) {
    const Floats d;
    const hn::RebindToUnsigned<Floats> du;
    const hn::RebindToSigned<Floats> di;
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
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
    const V3 in_index = cells.sides.in_form({row(0), row(1), row(2)});
    const auto flat_bits = hn::Ne(hn::And(word, hn::Set(du, index::kNormalBits)), hn::Zero(du));
    const auto is_flat =
        hn::And(hn::RebindMask(d, flat_bits), hn::Gt(dot(in_index, in_index), zero));
    const V3 any{zero, zero, one};
    const V3 normal = over_length(select(is_flat, in_index, any));
    constexpr float kStep = float(index::CellPlane::kFarthest / index::packed_plane::kFarthest);
    const auto byte = hn::ShiftRight<24>(hn::BitCast(di, word));
    const V offset = hn::Mul(hn::ConvertTo(d, byte), hn::Set(d, kStep));

    const V tiny = hn::Set(d, 1e-6f), half = hn::Set(d, 0.5f);
    const V3 size{hn::Max(hn::Abs(normal.x), tiny), hn::Max(hn::Abs(normal.y), tiny),
                  hn::Max(hn::Abs(normal.z), tiny)};
    const V sum = hn::Add(size.x, hn::Add(size.y, size.z));
    const V rest =
        hn::Max(hn::MulSub(half, sum, hn::Abs(offset)), hn::Set(d, SplatShape::kLeastRest));
    const V lower = hn::Min(size.x, size.y), upper = hn::Max(size.x, size.y);
    const V least = hn::Min(lower, size.z), median = hn::Max(lower, hn::Min(upper, size.z));
    const auto towards = [&](V of_size, V of_normal) HWY_ATTR {
        const V third = hn::Div(rest, hn::Mul(hn::Set(d, 3.0f), of_size));
        const V outwards = hn::Sub(half, hn::Min(third, half));
        return hn::CopySign(outwards, hn::Xor(of_normal, offset));
    };
    V3 at{towards(size.x, normal.x), towards(size.y, normal.y), towards(size.z, normal.z)};
    const V back = hn::Sub(offset, dot(normal, at));
    at = {hn::MulAdd(back, normal.x, at.x), hn::MulAdd(back, normal.y, at.y),
          hn::MulAdd(back, normal.z, at.z)};
    V3& center = cells.center;
    at = select(is_flat, at, {zero, zero, zero});
    const V3 shift = cells.sides.stretched(at);
    center = {hn::Add(center.x, shift.x), hn::Add(center.y, shift.y), hn::Add(center.z, shift.z)};
    const auto x_is = hn::Eq(size.x, least), y_is = hn::Eq(size.y, least);
    const V3 edge = select(x_is, {one, zero, zero}, select(y_is, {zero, one, zero}, any));
    const V lean = dot(edge, normal);
    const V3 lengthwise =
        over_length({hn::NegMulAdd(lean, normal.x, edge.x), hn::NegMulAdd(lean, normal.y, edge.y),
                     hn::NegMulAdd(lean, normal.z, edge.z)});
    const auto square = [&](V half_axis) HWY_ATTR {
        const V length =
            hn::Mul(cells.sides.half_axes(p.radius), hn::IfThenElse(is_flat, half_axis, one));
        return hn::Mul(length, length);
    };
    const auto clamped = [&](V length) {
        return hn::Clamp(length, hn::Set(d, SplatShape::kLeastWidth), one);
    };
    const V across2 = square(clamped(hn::Div(rest, median)));
    const V length2 = square(clamped(hn::Div(hn::Mul(rest, hn::Set(d, p.lengthwise)), least)));
    const V thickness2 = square(hn::Set(d, p.thickness));
    return {cells.sides,
            at,
            normal,
            lengthwise,
            across2,
            hn::Sub(thickness2, across2),
            hn::Sub(length2, across2)};
}

/// The stripes of the picture in which places in the cell are between its faces; see `CellSquares`.
/// @param a, b, over_w, xx, xy, yy as `project_shape` has them
template <class Shape, class Mask>
HWY_INLINE void write_stripes(const SquareProjection& p, const Shape& cells, const V3& a,
                              const V3& b, V over_w, V xx, V xy, V yy, Mask is_near, std::size_t i,
                              const SquareArrays& out) {
    const Floats d;
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const V3 along_a = cells.spread(a), along_b = cells.spread(b);
    const V share = hn::Div(over_w, hn::NegMulAdd(xy, xy, hn::Mul(xx, yy)));
    const auto write = [&](int axis, V place, V of_a, V of_b) HWY_ATTR {
        const V right = hn::Mul(share, hn::MulSub(yy, of_a, hn::Mul(xy, of_b)));
        const V up = hn::Mul(share, hn::MulSub(xx, of_b, hn::Mul(xy, of_a)));
        const V steep = hn::CopySign(hn::Max(hn::Abs(right), hn::Set(d, 1e-9f)), right);
        const V pixels = hn::Div(one, steep);
        const auto store = [&](int what, V value, V of_near) HWY_ATTR {
            hn::StoreU(hn::IfThenElse(is_near, of_near, value), d, out.stripes[axis][what] + i);
        };
        store(0, hn::Neg(hn::Mul(place, pixels)), zero);
        store(1, hn::Neg(hn::Mul(up, pixels)), zero);
        store(2, hn::Mul(hn::Set(d, p.half_cell), hn::Abs(pixels)), hn::Set(d, 4.0f * kFar));
    };
    write(0, cells.in_cell.x, along_a.x, along_b.x);
    write(1, cells.in_cell.y, along_a.y, along_b.y);
    write(2, cells.in_cell.z, along_a.z, along_b.z);
}

/// @tparam Shape of the cells, with a function `form`
template <bool kEllipses, class Shape, class Sides>
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
    if constexpr (kEllipses) {
        const V up = hn::Sqrt(yy), right = hn::Sqrt(xx);
        const V lean = hn::Div(xy, yy);
        store(everywhere, up, out.up);
        store(everywhere, hn::Sqrt(hn::Max(hn::NegMulAdd(xy, lean, xx), zero)), out.half);
        store(zero, lean, out.lean);
        store(zero, hn::Div(xy, right), out.tip);
        store(zero, hn::IfThenElseZero(hn::Lt(hn::Abs(z), hn::Set(d, kClipped)), one), out.inner);
        if (out.stripes[0][0])
            write_stripes(p, cells, a, b, over_w, xx, xy, yy, is_near, i, out);
    } else {
        store(zero, inner, out.inner);
        store(everywhere, outer, out.outer);
    }
    store(zero, hn::IfThenElseZero(whole, hn::Div(det, major)), out.inner_disc);
    store(everywhere, major, out.outer_disc);
}

/// Projects the next cells and stores the results from index `i` of the arrays.
/// @param planes null if the cells are spheres
template <CellKind kKind>
HWY_INLINE void project_next(const SquareProjection& p, const std::uint32_t* words,
                             const std::uint32_t* planes, std::size_t i, const SquareArrays& out) {
    auto cells = boxes<kKind>(p, words);
    if (planes) {
        const auto shape = ellipsoids(p, planes, cells);
        project_shape<true>(p, shape, cells, i, out);
    } else {
        const V radius = cells.sides.half_axes(p.radius);
        const Spheres<decltype(cells.sides)> shape{cells.sides, hn::Mul(radius, radius)};
        project_shape<false>(p, shape, cells, i, out);
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
    for (std::vector<float>* array : {&x_, &y_, &z_, &inner_, &inner_disc_, &outer_disc_})
        array->resize(whole);
    for (std::vector<float>* array : {&up_, &half_, &lean_, &tip_})
        array->resize(planes_.size());
    outer_.resize(on_planes ? 0 : whole);
    for (auto& axis : stripes_)
        for (std::vector<float>& array : axis)
            array.resize(on_planes && shape.in_cell ? whole : 0);
    const glm::vec2 half_size = 0.5f * glm::vec2(view.size);
    const glm::mat4 rows =
        glm::transpose(view.clip_from_eye * view.eye_from_room * placement.room_from_index);
    projection_ = {half_size.x * rows[0],
                   half_size.y * rows[1],
                   rows[2],
                   rows[3],
                   half_size,
                   shape.radius,
                   shape.thickness(),
                   shape.lengthwise(),
                   SplatShape::kHalfCell * shape.radius,
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
    if (slots.largest > 0) // of mixed levels
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
    SquareArrays arrays{from(x_),     from(y_),          from(z_),          from(inner_),
                        from(outer_), from(inner_disc_), from(outer_disc_), from(up_),
                        from(half_),  from(lean_),       from(tip_),        {}};
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
