// One eye's camera and viewport, as passes need them.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>

namespace isochron::render {

struct View {
    glm::mat4 clip_from_eye{1.0f}; ///< off-axis perspective (or orthographic), GL clip space
    glm::mat4 eye_from_room{1.0f}; ///< rotation and translation only
    glm::ivec2 size{0};            ///< size of the viewport, pixels
    glm::ivec2 corner{0};          ///< lower left of the viewport in the target, pixels
    /// `clip_from_eye` before `moved_by`; empty: it is not moved.
    std::optional<glm::mat4> unmoved{};

    bool operator==(const View&) const = default;
    bool is_parallel() const { return clip_from_eye[3][3] == 1.0f; } ///< orthographic
    glm::vec3 eye_in_room() const { return glm::vec3(glm::inverse(eye_from_room)[3]); }
    /// The view with its picture moved by so many pixels, for one of several samples of each pixel.
    View moved_by(glm::vec2 pixels) const {
        View moved = *this;
        moved.unmoved = clip_from_eye;
        for (int column = 0; column < 4; ++column)
            for (int axis = 0; axis < 2; ++axis)
                moved.clip_from_eye[column][axis] +=
                    2.0f * pixels[axis] / static_cast<float>(size[axis]) * clip_from_eye[column][3];
        return moved;
    }
    /// The view that is not moved: what has soft edges of its own is drawn with it, so that it stays
    /// sharp in the mean of several samples.
    View steady() const {
        View still = *this;
        if (unmoved)
            still.clip_from_eye = *unmoved;
        still.unmoved.reset();
        return still;
    }
};

} // namespace isochron::render
