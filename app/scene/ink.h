// The colors of words and lines that stand on the picture's background.
#pragma once

#include "interaction/setting_values.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace isochron::app {

inline constexpr glm::vec3 kPaperWhite(0.94f, 0.945f, 0.95f); ///< of the light background
inline constexpr glm::vec3 kDarkInk(0.13f, 0.15f, 0.18f);

/// Paper behind words has the color of the background, so that it is seen over the data only.
struct Ink {
    glm::vec4 text{0.90f, 0.92f, 0.95f, 1.0f};
    glm::vec4 paper{0.05f, 0.06f, 0.07f, 0.72f};
    float bright = 1.0f; ///< factor of the colors that axes have
};

inline Ink ink_on(interaction::Background background) {
    return background == interaction::Background::light
               ? Ink{glm::vec4(kDarkInk, 1.0f), glm::vec4(kPaperWhite, 0.72f), 0.6f}
               : Ink{};
}

} // namespace isochron::app
