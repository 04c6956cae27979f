// CIE L*a*b* from and to linear light.
#include "render/passes/cielab.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace isochron::render {
namespace {

/// IEC 61966-2-1; columns are the primaries, whose sum is the white D65.
const glm::mat3 kXyzFromLinear{
    {0.4124f, 0.2126f, 0.0193f}, {0.3576f, 0.7152f, 0.1192f}, {0.1805f, 0.0722f, 0.9505f}};
const glm::vec3 kWhite = kXyzFromLinear * glm::vec3(1.0f);
constexpr float kKnee = 6.0f / 29.0f;

float compressed(float t) {
    return t > kKnee * kKnee * kKnee ? std::cbrt(t) : t / (3 * kKnee * kKnee) + 4.0f / 29.0f;
}
float expanded(float t) {
    return t > kKnee ? t * t * t : 3 * kKnee * kKnee * (t - 4.0f / 29.0f);
}

} // namespace

glm::vec3 cielab_from_linear(const glm::vec3& light) {
    const glm::vec3 xyz = kXyzFromLinear * light / kWhite;
    const float x = compressed(xyz.x), y = compressed(xyz.y), z = compressed(xyz.z);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

glm::vec3 linear_from_cielab(const glm::vec3& lab) {
    const float y = (lab.x + 16) / 116;
    const glm::vec3 xyz(expanded(y + lab.y / 500), expanded(y), expanded(y - lab.z / 200));
    return glm::inverse(kXyzFromLinear) * (xyz * kWhite);
}

float color_difference(const glm::vec3& lab_a, const glm::vec3& lab_b) {
    return glm::length(lab_a - lab_b);
}

} // namespace isochron::render
