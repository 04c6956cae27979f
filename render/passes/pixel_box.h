// The pixels of a view that show a box in the room.
#pragma once

#include "render/gl/view.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

namespace isochron::render {

struct PixelBox {
    glm::ivec2 low, high; ///< `high` lies outside
};

/// The pixels that show a box; all of the view if a corner is behind the eye.
/// @param room_from_box the box is that of 0 to 1 along each axis
PixelBox pixel_box(const View& view, const glm::mat4& room_from_box);

} // namespace isochron::render
