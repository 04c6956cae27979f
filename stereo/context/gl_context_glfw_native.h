// The native handles of a GLFW window's context; for gl_context_glfw.cpp alone.
#pragma once

#include "stereo/context/native_gl.h"

struct GLFWwindow;

namespace isochron::stereo {

/// @return nothing where the window system is neither X11 nor the context one of EGL
NativeGl native_of(GLFWwindow* window);

} // namespace isochron::stereo
