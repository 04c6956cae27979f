// Projection of cells as the vertex shader does it; compiled once for each SIMD target and chosen
// at run time.
#include "render/cells/cell_squares.h"

#include "render/cells/point_sprites.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <cstring>

#ifndef ISOCHRON_CELL_SQUARES_TYPES
#define ISOCHRON_CELL_SQUARES_TYPES
namespace isochron::render {

/// What is the same for all cells.
struct SquareProjection {
    glm::vec4 row_x, row_y, row_z, row_w; ///< from index to clip space, x and y in pixels
    glm::vec2 middle;                     ///< of the viewport, pixels
    float radius;
};

/// Where the results go.
struct SquareArrays {
    float *x, *y, *z, *inner, *outer, *inner_disc, *outer_disc;
};

} // namespace isochron::render
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cells/cell_squares.cpp"
#include <hwy/foreach_target.h> // must come before highway.h

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace isochron::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, CellSquares::kBlock>;
using V = hn::Vec<Floats>;

/// As in cell.vert: the quad of an ellipse is upright up to this (a^2 - b^2) / (a^2 + b^2) of its
/// half axes.
constexpr float kRound = 0.1f;
constexpr float kClipped = 1.0f - 1e-6f; ///< what the frustum's ends may cut hides nothing
/// As kLeastDepth, of an eye that is two radii away: from there on nothing of a splat fades.
constexpr float kWholeDepth = 0.75f;
constexpr float kFar = 1e9f; ///< beyond any view and before any depth

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

/// Middles of the cells of the next words.
HWY_INLINE V3 centers(const std::uint32_t* words) {
    const Floats d;
    const hn::RebindToUnsigned<Floats> du;
    const hn::RebindToSigned<Floats> di;
    hn::Vec<decltype(du)> xy, z_style;
    hn::LoadInterleaved2(du, words, xy, z_style);
    const auto low = hn::Set(du, 0xffffu);
    const V half = hn::Set(d, 0.5f);
    const auto middle = [&](hn::Vec<decltype(du)> cell) {
        return hn::Add(hn::ConvertTo(d, hn::BitCast(di, cell)), half);
    };
    return {middle(hn::And(xy, low)), middle(hn::ShiftRight<16>(xy)),
            middle(hn::And(z_style, low))};
}

/// The squares of the cells of the next words, to index `i` of the arrays.
HWY_INLINE void project_next(const SquareProjection& p, const std::uint32_t* words, std::size_t i,
                             const SquareArrays& out) {
    const Floats d;
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), two = hn::Set(d, 2.0f);
    const float radius2 = p.radius * p.radius;
    const float tilt2 = glm::dot(glm::vec3(p.row_w), glm::vec3(p.row_w));
    const V rr = hn::Set(d, radius2);
    const V3 center = centers(words), row_w = set(p.row_w);
    const V w = at(p.row_w, center);
    const V depth = hn::Sub(hn::Mul(w, w), hn::Set(d, radius2 * tilt2));
    const auto is_near =
        hn::Or(hn::Le(w, zero), hn::Le(depth, hn::Mul(hn::Set(d, kLeastDepth), hn::Mul(w, w))));
    const auto behind = hn::Lt(w, hn::Set(d, -1.01f * p.radius * std::sqrt(tilt2)));

    const V over_w = hn::Div(one, w);
    const V x = hn::Mul(at(p.row_x, center), over_w), y = hn::Mul(at(p.row_y, center), over_w);
    const V z = hn::Mul(at(p.row_z, center), over_w);
    const auto off = [&](const glm::vec4& row, V along) {
        const V3 all = set(row);
        return V3{hn::NegMulAdd(along, row_w.x, all.x), hn::NegMulAdd(along, row_w.y, all.y),
                  hn::NegMulAdd(along, row_w.z, all.z)};
    };
    const V3 a = off(p.row_x, x), b = off(p.row_y, y);
    const V k = hn::Div(rr, depth);
    const V shift_x = hn::Neg(hn::Mul(k, dot(a, row_w)));
    const V shift_y = hn::Neg(hn::Mul(k, dot(b, row_w)));
    const V xx = hn::MulAdd(shift_x, shift_x, hn::Mul(k, dot(a, a)));
    const V xy = hn::MulAdd(shift_x, shift_y, hn::Mul(k, dot(a, b)));
    const V yy = hn::MulAdd(shift_y, shift_y, hn::Mul(k, dot(b, b)));
    // Of a nearly round ellipse the quad is the image of a square under the symmetric root of its
    // shape, (s + sqrt(det s)) / sqrt(trace s + 2 sqrt(det s)).
    const V det = hn::Sqrt(hn::Max(hn::NegMulAdd(xy, xy, hn::Mul(xx, yy)), zero));
    const V trace = hn::Add(xx, yy), apart = hn::Sub(xx, yy);
    const V most = hn::Div(hn::Add(hn::Max(xx, yy), hn::Add(det, hn::Abs(xy))),
                           hn::Sqrt(hn::MulAdd(two, det, trace)));
    // Times the mean: of its half axes.
    const V uneven = hn::Sqrt(hn::MulAdd(apart, apart, hn::Mul(hn::Set(d, 4.0f), hn::Mul(xy, xy))));
    const auto round = hn::Lt(uneven, hn::Mul(hn::Set(d, kRound), trace));
    const auto hides = hn::And(round, hn::Lt(hn::Abs(z), hn::Set(d, kClipped)));
    const V inner = hn::IfThenElseZero(hides, hn::Div(det, most));
    const V outer = hn::IfThenElse(round, most, hn::Sqrt(hn::Add(trace, uneven)));

    const V major = hn::Sqrt(hn::Mul(hn::Set(d, 0.5f), hn::Add(trace, uneven)));
    const auto whole = hn::And(hn::Lt(hn::Abs(z), hn::Set(d, kClipped)),
                               hn::Ge(depth, hn::Mul(hn::Set(d, kWholeDepth), hn::Mul(w, w))));

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

} // namespace

void project(const SquareProjection& projection, const std::uint32_t* words, std::size_t cells,
             const SquareArrays& out) {
    for (std::size_t i = 0; i < cells; i += hn::Lanes(Floats()))
        project_next(projection, words + 2 * i, i, out);
}

} // namespace isochron::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::render {

HWY_EXPORT(project);

void CellSquares::project(const View& view, const Placement& placement, float radius,
                          std::span<const CellPlace> places,
                          std::span<const std::uint32_t> back_to_front) {
    size_ = back_to_front.size();
    const std::size_t whole = (size_ + kBlock - 1) / kBlock * kBlock;
    words_.resize(2 * whole);
    for (std::vector<float>* array : {&x_, &y_, &z_, &inner_, &outer_, &inner_disc_, &outer_disc_})
        array->resize(whole);
    for (std::size_t i = 0; i < size_; ++i)
        std::memcpy(&words_[2 * i], &places[back_to_front[size_ - 1 - i]], sizeof(CellPlace));
    const glm::vec2 half_size = 0.5f * glm::vec2(view.size);
    const glm::mat4 rows =
        glm::transpose(view.clip_from_eye * view.eye_from_room * placement.room_from_index);
    const SquareProjection projection{
        half_size.x * rows[0], half_size.y * rows[1], rows[2], rows[3], half_size, radius};
    HWY_DYNAMIC_DISPATCH(project)
    (projection, words_.data(), whole,
     {x_.data(), y_.data(), z_.data(), inner_.data(), outer_.data(), inner_disc_.data(),
      outer_disc_.data()});
}

} // namespace isochron::render
#endif
