// Swaps all windows of a cluster at once, by NVIDIA's driver and its synchronization boards.
#pragma once

#include "render/gl/gl.h"

namespace isochron::stereo {

/// Puts the current window into swap group 1 of its display, and the group into swap barrier 1,
/// which the machines of a cluster share if their boards are connected. From then on, until the
/// window is closed, the driver shows a new frame only when all windows have one.
/// Source: GLX_NV_swap_group, OpenGL extension registry.
/// @param load entry points of the current context's window system
/// @throws render::Error in one line: what is missing in the driver or the boards
void join_swap_group(const render::GlLoader& load);

} // namespace isochron::stereo
