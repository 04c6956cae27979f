// Waits for the window system's events; only for gl_context_glfw.cpp.
#pragma once

#include "interaction/pose.h"
#include "stereo/context/wake.h"

namespace isochron::stereo {

/// Lets GLFW handle the events that come; returns at the first, or when somebody wakes or the time
/// is over.
/// @return false: only because the time is over
bool wait_for_window_events(const Wake& wake, interaction::Seconds longest);

} // namespace isochron::stereo
