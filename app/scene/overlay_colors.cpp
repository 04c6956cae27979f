// The colors of words and lines that stand on the picture's background.
#include "app/scene/overlay_colors.h"

#include "render/gl/srgb.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace isochron::app {
namespace {

float luminance(const glm::vec3& srgb) {
    return glm::dot(render::linear_from_srgb(srgb), glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

float contrast_of(const glm::vec3& a, const glm::vec3& b) {
    const auto [dark, light] = std::minmax({luminance(a), luminance(b)});
    return (light + 0.05f) / (dark + 0.05f);
}

} // namespace

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
