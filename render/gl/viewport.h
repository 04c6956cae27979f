// Leads draws to where a view lies in its target.
#pragma once

#include "render/gl/gl.h"
#include "render/gl/view.h"

namespace isochron::render {

/// Draws go to the view's viewport from now on and, where the scissor test is on, nowhere else.
/// @param index of the viewport, where vertex shaders choose one; without a choice it is 0
inline void set_viewport(const Gl& gl, const View& view, GLuint index = 0) {
    const glm::vec2 corner(view.corner), size(view.size);
    gl.ViewportIndexedf(index, corner.x, corner.y, size.x, size.y);
    gl.ScissorIndexed(index, view.corner.x, view.corner.y, view.size.x, view.size.y);
}

} // namespace isochron::render
