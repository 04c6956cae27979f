// The types of GLX, without <GL/glx.h>, which would declare all of GL a second time. Include it
// before headers that conflict with Xlib's macros; it undefines some of these.
#pragma once

#include <X11/Xlib.h>

using GLXFBConfig = struct __GLXFBConfigRec*;
using GLXContext = struct __GLXcontextRec*;
using GLXDrawable = XID;
using GLXWindow = XID;

#undef Always
#undef Bool
#undef None
#undef Status
#undef Success
