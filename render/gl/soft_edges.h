// Blending of what has soft edges, and the depth of what has a core: lines and text.
#pragma once

#include "render/gl/gl.h"

namespace isochron::render {

/// Pre-multiplied colors go over what is there.
inline void blend_over(const Gl& gl) {
    gl.Enable(GL_BLEND);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

/// First all colors, then the depth of the cores alone, where they are all there is: a soft edge
/// that wrote depth would keep what is drawn later from showing through it. Leaves colors and
/// depth writes on.
/// @param draw called with whether depth alone is drawn
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
