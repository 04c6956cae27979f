// The transfer curve of sRGB: between a display's values and the light that it emits.
#pragma once

#include <glm/vec3.hpp>

#include <cmath>

namespace isochron::render {

/// Linear light of an sRGB value, both 0 to 1 (IEC 61966-2-1).
inline float linear_from_srgb(float value) {
    return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}
inline glm::vec3 linear_from_srgb(const glm::vec3& v) {
    return {linear_from_srgb(v.x), linear_from_srgb(v.y), linear_from_srgb(v.z)};
}

/// The sRGB value for linear light, both 0 to 1.
inline float srgb_from_linear(float light) {
    return light <= 0.0031308f ? light * 12.92f : 1.055f * std::pow(light, 1.0f / 2.4f) - 0.055f;
}
inline glm::vec3 srgb_from_linear(const glm::vec3& v) {
    return {srgb_from_linear(v.x), srgb_from_linear(v.y), srgb_from_linear(v.z)};
}

} // namespace isochron::render
