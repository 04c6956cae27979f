// The native handles of a GLFW window's context; only for gl_context_glfw.cpp.
#pragma once

#include "stereo/context/native_gl.h"

struct GLFWwindow;

namespace isochron::stereo {

/// @return empty if the context was not made by EGL and the window system is not X11
NativeGl native_of(GLFWwindow* window);

} // namespace isochron::stereo
