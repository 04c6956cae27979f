// Blending and depth of lines and text, which have soft edges around a core.
#pragma once

#include "render/gl/gl.h"

namespace isochron::render {

/// Blends pre-multiplied colors over the target.
inline void blend_over(const Gl& gl) {
    gl.Enable(GL_BLEND);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

/// Draws all colors first, and then only the depth of the cores, without their soft edges: a soft
/// edge that wrote depth would hide things behind it that are drawn later. Leaves colors and depth
/// writes on.
/// @param draw called with true to draw only depth
template <class Draw>
void draw_colors_then_depth(const Gl& gl, bool with_depth, Draw&& draw) {
    gl.DepthMask(GL_FALSE);
    draw(false);
    gl.DepthMask(GL_TRUE);
    if (!with_depth)
        return;
    gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw(true);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

} // namespace isochron::render
