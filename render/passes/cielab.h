// CIE L*a*b*: colors by how different they look.
#pragma once

#include <glm/vec3.hpp>

namespace isochron::render {

/// Linear light of sRGB primaries to L* (0 to 100), a*, b*, white D65 (CIE 15:2004).
glm::vec3 cielab_from_linear(const glm::vec3& light);
/// The inverse; outside 0 to 1 where no display can show the color.
glm::vec3 linear_from_cielab(const glm::vec3& lab);

/// Distance of two colors as it looks, Delta E*ab of 1976.
float color_difference(const glm::vec3& lab_a, const glm::vec3& lab_b);

} // namespace isochron::render
