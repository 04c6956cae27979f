// A view straight down on ten by ten units, and light in which colors are those of what is drawn.
#pragma once

#include "render/cells/cell_appearance.h"
#include "render/gl/view.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/vec4.hpp>

#include <vector>

namespace isochron::render {

/// @param pixels along each side
inline View flat_view(int pixels) {
    return {.clip_from_eye = glm::ortho(-5.0f, 5.0f, -5.0f, 5.0f, 1.0f, 100.0f),
            .eye_from_room = glm::lookAt(glm::vec3(5, 5, 20), glm::vec3(5, 5, 0), {0, 1, 0}),
            .size = {pixels, pixels}};
}

/// All light is ambient.
inline CellAppearance flat_light(const std::vector<glm::vec4>& cuts) {
    CellAppearance look;
    look.ambient = look.ground = 1;
    look.head_light = look.key_light = look.reflectance = look.outline = look.depth_cue = 0;
    look.cuts = cuts;
    return look;
}

} // namespace isochron::render
