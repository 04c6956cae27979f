// The word "loading", which windows show at the start. It is drawn without shaders and fonts, which
// take too long to load.
#pragma once

#include "render/gl/gl.h"
#include "stereo/windows.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace isochron::stereo {

/// Draws the word in the middle of the bound framebuffer.
/// @param size of the framebuffer, pixels
/// @param background sRGB, around the word
void draw_loading(const render::GlLoader& loader, glm::ivec2 size, glm::vec3 background);

/// Shows it in every window. The drawing context is current again afterwards.
void show_loading(const Windows& windows, glm::vec3 background);

} // namespace isochron::stereo
