// What drivers promise is tried once before it is relied on.
#pragma once

#include "render/gl/gl.h"

namespace isochron::render {

/// Whether a draw reaches two viewports, as ARB_shader_viewport_layer_array promises. It is tried:
/// Mesa 22.3's zink has the extension but leaves the second viewport empty where a program that
/// chooses none has drawn before. Leaves no framebuffer bound and the viewports undefined.
bool draws_to_two_viewports(const Gl& gl);

/// Whether fences are ever passed; waits for a second at most.
bool passes_fences(const Gl& gl);

} // namespace isochron::render
