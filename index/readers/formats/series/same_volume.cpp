// Compares volumes.
#include "index/readers/formats/series/same_volume.h"

#include "index/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace isochron::index {
namespace {

bool close(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& tolerance) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(a[axis] - b[axis]) <= tolerance[axis]))
            return false;
    return true;
}

/// Compares positions of grids with as many vertices: one grid may be even but for rounding, and
/// the other not.
bool same_positions(const Grid& a, const Grid& b, std::size_t axis) {
    constexpr double kSlack = 1e-4; // share of the spacing
    if (a.positions[axis] == b.positions[axis])
        return true;
    const int i = static_cast<int>(axis);
    for (std::uint32_t vertex = 0; vertex < a.vertices[axis]; ++vertex)
        if (!(std::abs(a.distance(i, vertex) - b.distance(i, vertex)) <= kSlack * b.spacing[i]))
            return false;
    return true;
}

std::string text(const glm::dvec3& v) {
    return fmt::format("({} {} {})", v.x, v.y, v.z);
}

std::string text(Anatomy anatomy) {
    switch (anatomy) {
    case Anatomy::ras: return "right-anterior-superior";
    case Anatomy::lps: return "left-posterior-superior";
    case Anatomy::enu: return "east-north-up";
    case Anatomy::none: break;
    }
    return "not anatomical";
}

} // namespace

void expect_same(const SeriesInfo& got, const std::string& file, const SeriesInfo& first,
                 const std::string& first_file) {
    const auto fail = [&](const std::string& what, const std::string& is, const std::string& was) {
        throw Error("{}: {} {}, {} has {}", file, what, is, first_file, was);
    };
    const Grid &a = got.grid, &b = first.grid;
    if (a.vertices != b.vertices)
        fail("dimensions", fmt::format("{}x{}x{}", a.vertices[0], a.vertices[1], a.vertices[2]),
             fmt::format("{}x{}x{}", b.vertices[0], b.vertices[1], b.vertices[2]));
    if (got.array != first.array)
        fail("array", got.array, first.array);
    if (got.type != first.type)
        throw Error("{}: type {}, {} has {}; --type f32 reads both as f32", file, name_of(got.type),
                    first_file, name_of(first.type));
    if (!close(a.spacing, b.spacing, b.spacing * 1e-6))
        fail("spacing", text(a.spacing), text(b.spacing));
    if (!close(a.origin, b.origin,
               glm::dvec3(1e-4 * std::min({b.spacing.x, b.spacing.y, b.spacing.z}))))
        fail("origin", text(a.origin), text(b.origin));
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (!same_positions(a, b, axis))
            throw Error("{}: other positions of vertices along axis {} than {}", file, axis,
                        first_file);
    for (int axis = 0; axis < 3; ++axis)
        if (!close(a.direction[axis], b.direction[axis], glm::dvec3(1e-5)))
            fail(fmt::format("direction of axis {}", axis), text(a.direction[axis]),
                 text(b.direction[axis]));
    if (got.scaling != first.scaling)
        fail("scaling", fmt::format("{} x + {}", got.scaling.slope, got.scaling.intercept),
             fmt::format("{} x + {}", first.scaling.slope, first.scaling.intercept));
    if (got.anatomy != first.anatomy)
        fail("space", text(got.anatomy), text(first.anatomy));
}

} // namespace isochron::index
