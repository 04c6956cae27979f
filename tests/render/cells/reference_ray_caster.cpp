// Casts rays through a trilinear field, cell by cell.
#include "tests/render/cells/reference_ray_caster.h"

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace isochron::render {

namespace {

/// Bernstein coefficients of a cubic over an interval.
using Bernstein = std::array<double, 4>;

/// The cubic with these values at 0, 1/3, 2/3 and 1.
Bernstein through(const std::array<double, 4>& f) {
    return {f[0], (-5 * f[0] + 18 * f[1] - 9 * f[2] + 2 * f[3]) / 6,
            (2 * f[0] - 9 * f[1] + 18 * f[2] - 5 * f[3]) / 6, f[3]};
}

/// Appends where the sign changes between `from` and `to`, in order.
void roots(const Bernstein& c, double from, double to, std::vector<double>& found) {
    const auto above = [](double value) { return value >= 0.0; };
    const auto count = std::count_if(c.begin(), c.end(), above);
    if (count == 0 || count == 4)
        return;
    if (to - from < 1e-12) {
        if (above(c[0]) != above(c[3]))
            found.push_back(0.5 * (from + to));
        return;
    }
    const double c01 = 0.5 * (c[0] + c[1]), c12 = 0.5 * (c[1] + c[2]), c23 = 0.5 * (c[2] + c[3]);
    const double left = 0.5 * (c01 + c12), right = 0.5 * (c12 + c23), middle = 0.5 * (left + right);
    const double half = 0.5 * (from + to);
    roots({c[0], c01, left, middle}, from, half, found);
    roots({middle, right, c23, c[3]}, half, to, found);
}

/// Where the segment from `a` to `b` meets planes of vertices within the volume, with both ends of
/// its part in there; sorted.
std::vector<double> crossings(const glm::dvec3& a, const glm::dvec3& b, const VertexField& field) {
    const glm::ivec3 cells = field.cells();
    double from = 0.0, to = 1.0;
    std::vector<double> all;
    for (int axis = 0; axis < 3; ++axis) {
        const double step = b[axis] - a[axis];
        if (step == 0.0) {
            if (a[axis] < 0.0 || a[axis] > cells[axis])
                return {};
            continue;
        }
        const double low = (0.0 - a[axis]) / step, high = (cells[axis] - a[axis]) / step;
        from = std::max(from, std::min(low, high));
        to = std::min(to, std::max(low, high));
        for (int plane = 0; plane <= cells[axis]; ++plane)
            all.push_back((field.place(axis, plane) - a[axis]) / step);
    }
    if (from >= to)
        return {};
    std::erase_if(all, [&](double t) { return t <= from || t >= to; });
    all.push_back(from);
    all.push_back(to);
    std::sort(all.begin(), all.end());
    return all;
}

} // namespace

ReferenceRayCaster::ReferenceRayCaster(const VertexField& field, const View& view,
                                       const Placement& placement)
    : field_(&field), size_(view.size),
      clip_from_index_(glm::dmat4(view.clip_from_eye) * glm::dmat4(view.eye_from_room) *
                       glm::dmat4(placement.room_from_index)) {
    index_from_clip_ = glm::inverse(clip_from_index_);
}

glm::dvec3 ReferenceRayCaster::point(glm::dvec2 pixel, double depth) const {
    const glm::dvec2 on_screen = 2.0 * pixel / size_ - 1.0;
    const glm::dvec4 p =
        index_from_clip_ * glm::dvec4(on_screen.x, on_screen.y, 2.0 * depth - 1.0, 1.0);
    return glm::dvec3(p.x, p.y, p.z) / p.w;
}

void ReferenceRayCaster::cast(glm::dvec2 pixel, bool first_only, std::vector<RayHit>& found) const {
    const glm::dvec3 near = point(pixel, 0.0), far = point(pixel, 1.0);
    const std::vector<double> planes = crossings(near, far, *field_);
    std::vector<double> in_cell;
    for (std::size_t i = 0; i + 1 < planes.size(); ++i) {
        const glm::dvec3 a = glm::mix(near, far, planes[i]), b = glm::mix(near, far, planes[i + 1]);
        const glm::dvec3 within = 0.5 * (a + b);
        glm::ivec3 cell(0);
        glm::dvec3 corner, size;
        for (int axis = 0; axis < 3; ++axis) {
            while (cell[axis] + 1 < field_->cells()[axis] &&
                   field_->place(axis, cell[axis] + 1) <= within[axis])
                ++cell[axis];
            corner[axis] = field_->place(axis, cell[axis]);
            size[axis] = field_->place(axis, cell[axis] + 1) - corner[axis];
        }
        std::array<double, 4> f;
        for (int j = 0; j < 4; ++j)
            f[j] = field_->value(cell, (glm::mix(a, b, j / 3.0) - corner) / size);
        in_cell.clear();
        if (std::isfinite(f[0] + f[1] + f[2] + f[3]))
            roots(through(f), 0.0, 1.0, in_cell);
        for (const double t : in_cell) {
            const glm::dvec3 at = glm::mix(a, b, t);
            const glm::dvec4 clip = clip_from_index_ * glm::dvec4(at, 1.0);
            found.push_back({at, 0.5 + 0.5 * clip.z / clip.w, cell,
                             field_->gradient(cell, (at - corner) / size)});
            if (first_only)
                return;
        }
    }
}

std::vector<RayHit> ReferenceRayCaster::hits(glm::dvec2 pixel) const {
    std::vector<RayHit> found;
    cast(pixel, false, found);
    return found;
}

std::optional<RayHit> ReferenceRayCaster::first_hit(glm::dvec2 pixel) const {
    std::vector<RayHit> found;
    cast(pixel, true, found);
    return found.empty() ? std::nullopt : std::optional(found.front());
}

} // namespace isochron::render
