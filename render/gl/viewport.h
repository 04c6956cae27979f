// Sets the viewport of a view.
#pragma once

#include "render/gl/gl.h"
#include "render/gl/view.h"

namespace isochron::render {

/// Sets the GL viewport, and the rectangle of the scissor test, to the view's rectangle.
/// @param index of the viewport, for vertex shaders that choose one; others use 0
inline void set_viewport(const Gl& gl, const View& view, GLuint index = 0) {
    const glm::vec2 corner(view.corner), size(view.size);
    gl.ViewportIndexedf(index, corner.x, corner.y, size.x, size.y);
    gl.ScissorIndexed(index, view.corner.x, view.corner.y, view.size.x, view.size.y);
}

} // namespace isochron::render
