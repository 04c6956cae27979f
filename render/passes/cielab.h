// CIE L*a*b*: a color space in which distances match how different colors look.
#pragma once

#include <glm/vec3.hpp>

namespace isochron::render {

/// Converts linear light of sRGB primaries to L* (0 to 100), a*, b*, with white D65 (CIE 15:2004).
glm::vec3 cielab_from_linear(const glm::vec3& light);
/// The inverse; outside 0 to 1 for colors that no display can show.
glm::vec3 linear_from_cielab(const glm::vec3& lab);

/// Perceived difference of two colors, Delta E*ab of 1976.
float color_difference(const glm::vec3& lab_a, const glm::vec3& lab_b);

} // namespace isochron::render
