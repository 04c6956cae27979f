// The colors of words, lines and the paper behind words, which lie over a picture: they suit its
// background.
#pragma once

#include "interaction/setting_values.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <vector>

namespace isochron::app {

inline constexpr glm::vec3 kPaperWhite(0.94f, 0.945f, 0.95f); ///< the light background
inline constexpr glm::vec3 kDarkText(0.13f, 0.15f, 0.18f);
inline constexpr glm::vec3 kLifted(0.27f, 0.28f, 0.29f);    ///< the gray background
inline constexpr glm::vec3 kLowerSky(0.11f, 0.13f, 0.165f); ///< the gradient, near its foot

/// The color of paper is that of the background, so that paper is seen over the data only.
struct OverlayColors {
    glm::vec4 text{0.90f, 0.92f, 0.95f, 1.0f};
    glm::vec4 paper{0.05f, 0.06f, 0.07f, 0.72f};
    float bright = 1.0f; ///< factor of the colors that axes have

    glm::vec4 halo() const { return {glm::vec3(paper), 0.85f}; } ///< color around words
};

/// Whether words and lines on it are dark.
constexpr bool is_light(interaction::Background background) {
    return background == interaction::Background::light ||
           background == interaction::Background::white;
}

inline OverlayColors overlay_colors_on(interaction::Background background) {
    OverlayColors overlay;
    switch (background) {
    case interaction::Background::dark: break;
    case interaction::Background::light:
        return {glm::vec4(kDarkText, 1.0f), glm::vec4(kPaperWhite, 0.72f), 0.6f};
    case interaction::Background::white:
        return {glm::vec4(kDarkText, 1.0f), glm::vec4(1.0f, 1.0f, 1.0f, 0.72f), 0.6f};
    case interaction::Background::gradient: overlay.paper = glm::vec4(kLowerSky, 0.72f); break;
    case interaction::Background::gray: overlay.paper = glm::vec4(kLifted, 0.72f); break;
    }
    return overlay;
}

/// The contrast (WCAG 2.1) that the darkest color of a map has to have against the background.
inline constexpr float kDarkEndContrast = 1.5f;
/// Whether a map's darkest color vanishes on a background, and is seen on the gray one.
/// @param map linear light @param background sRGB
bool wants_lifting(const std::vector<glm::vec3>& map, const glm::vec3& background);

/// The color itself, or mixed with as little of the text's color as gives words of it a contrast of
/// at least 4.5 to 1 on this paper, whatever lies behind the paper.
/// @param paper sRGB, with its opacity @param color sRGB
glm::vec3 legible_on(const glm::vec4& paper, const glm::vec3& color, const OverlayColors& overlay);

} // namespace isochron::app
