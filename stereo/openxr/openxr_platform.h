// OpenXR's headers with the graphics bindings of EGL and GLX. Include it before other headers.
#pragma once

#include "stereo/context/glx_types.h"

#define EGL_NO_X11
#include <EGL/egl.h>

#include <ctime>

#define XR_USE_PLATFORM_XLIB
#define XR_USE_PLATFORM_EGL
#define XR_USE_GRAPHICS_API_OPENGL
#define XR_USE_TIMESPEC
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>
