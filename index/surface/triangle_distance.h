// How far a point is from a triangle.
#pragma once

#include <glm/vec3.hpp>

#include <array>

namespace isochron::index {

/// Square of the distance from a point to a triangle, which may have no area.
double squared_distance(const glm::dvec3& point, const std::array<glm::dvec3, 3>& triangle);

} // namespace isochron::index
