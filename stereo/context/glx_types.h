// The types of GLX as <GL/glx.h> declares them, which would bring a second set of GL's declarations
// along. Comes before headers that Xlib's common words would spoil; it takes some of them back.
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
