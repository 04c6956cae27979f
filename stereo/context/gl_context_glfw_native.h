// What of GLFW depends on the window system.
#pragma once

#include "stereo/context/native_gl.h"

struct GLFWwindow;

namespace isochron::stereo {

/// GLFW's function of that name; null: this GLFW lacks it.
void* glfw_function(const char* name);

/// The native handles of a window's context.
/// @return empty if the context was not made by EGL and the window system is not X11
NativeGl native_of(GLFWwindow* window);

} // namespace isochron::stereo
