// The colors of words and lines that stand on the picture's background.
#include "app/scene/overlay_colors.h"

#include "render/gl/srgb.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace isochron::app {
namespace {

float luminance_of_linear(const glm::vec3& color) {
    return glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

float luminance(const glm::vec3& srgb) {
    return luminance_of_linear(render::linear_from_srgb(srgb));
}

float contrast_of(float a, float b) {
    const auto [dark, light] = std::minmax({a, b});
    return (light + 0.05f) / (dark + 0.05f);
}

float contrast_of(const glm::vec3& a, const glm::vec3& b) {
    return contrast_of(luminance(a), luminance(b));
}

} // namespace

bool wants_lifting(const std::vector<glm::vec3>& map, const glm::vec3& background) {
    if (map.empty())
        return false;
    const float darkest = luminance_of_linear(
        *std::ranges::min_element(map, {}, [](const glm::vec3& color) {
            return luminance_of_linear(color);
        }));
    return contrast_of(darkest, luminance(background)) < kDarkEndContrast &&
           contrast_of(darkest, luminance(kLifted)) >= kDarkEndContrast;
}

glm::vec3 legible_on(const glm::vec4& paper, const glm::vec3& color, const OverlayColors& overlay) {
    constexpr float kContrast = 4.5f;
    constexpr int kMixtures = 20;
    // Behind light paper what is black shines through most, behind dark paper what is white.
    const glm::vec3 behind(luminance(glm::vec3(paper)) > 0.5f ? 0.0f : 1.0f);
    const glm::vec3 worst = glm::mix(behind, glm::vec3(paper), paper.w);
    for (int i = 0; i < kMixtures; ++i) {
        const glm::vec3 mixed =
            glm::mix(color, glm::vec3(overlay.text), static_cast<float>(i) / kMixtures);
        if (contrast_of(mixed, worst) >= kContrast)
            return mixed;
    }
    return glm::vec3(overlay.text);
}

} // namespace isochron::app
