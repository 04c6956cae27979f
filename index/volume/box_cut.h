// Where a plane cuts a box.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace isochron::index {

/// The places where a plane crosses the twelve edges of a box from 0 to `size`.
/// @param beyond how far a place of the box lies beyond the plane, in any unit
template <class Beyond>
std::vector<glm::dvec3> edges_cut(const glm::dvec3& size, const Beyond& beyond) {
    std::vector<glm::dvec3> places;
    for (int axis = 0; axis < 3; ++axis)
        for (int edge = 0; edge < 4; ++edge) {
            glm::dvec3 from(0.0);
            from[(axis + 1) % 3] = edge & 1 ? size[(axis + 1) % 3] : 0;
            from[(axis + 2) % 3] = edge >> 1 ? size[(axis + 2) % 3] : 0;
            glm::dvec3 to = from;
            to[axis] = size[axis];
            const double low = beyond(from), high = beyond(to);
            if ((low < 0) == (high < 0))
                continue;
            from[axis] = low / (low - high) * size[axis];
            places.push_back(from);
        }
    return places;
}

/// The corners of a flat convex polygon in their order around it; nothing for fewer than three.
/// @param normal unit
inline std::vector<glm::dvec3> in_order(std::vector<glm::dvec3> corners, const glm::dvec3& normal) {
    if (corners.size() < 3)
        return {};
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& corner : corners)
        middle += corner / static_cast<double>(corners.size());
    const glm::dvec3 right = glm::normalize(corners.front() - middle);
    const glm::dvec3 up = glm::cross(normal, right);
    std::ranges::sort(corners, {}, [&](const glm::dvec3& corner) {
        return std::atan2(glm::dot(corner - middle, up), glm::dot(corner - middle, right));
    });
    return corners;
}

} // namespace isochron::index
