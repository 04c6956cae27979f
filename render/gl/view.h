// One eye's camera and viewport, as passes need them.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace isochron::render {

struct View {
    glm::mat4 clip_from_eye{1.0f}; ///< off-axis perspective (or orthographic), GL clip space
    glm::mat4 eye_from_room{1.0f}; ///< rotation and translation only
    glm::ivec2 size{0};            ///< size of the viewport, pixels
    glm::ivec2 corner{0};          ///< lower left of the viewport in the target, pixels

    bool operator==(const View&) const = default;
    bool is_parallel() const { return clip_from_eye[3][3] == 1.0f; } ///< orthographic
    glm::vec3 eye_in_room() const { return glm::vec3(glm::inverse(eye_from_room)[3]); }
};

} // namespace isochron::render
