// Tests whether drivers keep their promises, before the program relies on them.
#pragma once

#include "render/gl/gl.h"

namespace isochron::render {

/// Draws to two viewports at once and checks the result, as ARB_shader_viewport_layer_array
/// promises it: Mesa 22.3's zink has the extension but leaves the second viewport empty if a
/// program that chooses no viewport has drawn before. Leaves no framebuffer bound and the viewports
/// undefined.
bool draws_to_two_viewports(const Gl& gl);

/// Whether the GPU ever passes a fence; waits for at most a second.
bool passes_fences(const Gl& gl);

} // namespace isochron::render
