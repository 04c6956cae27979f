// What windows show before there is anything to show: the word "loading", without shaders or fonts,
// which take longer to come than people like to wait.
#pragma once

#include "render/gl/gl.h"
#include "stereo/windows.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace isochron::stereo {

/// Draws the word in the middle of the framebuffer that is bound, of the current context.
/// @param size of the framebuffer, pixels
/// @param background sRGB, around the word
void draw_loading(const render::GlLoader& loader, glm::ivec2 size, glm::vec3 background);

/// Shows it in every window there is. The context that draws is current again afterwards.
void show_loading(const Windows& windows, glm::vec3 background);

} // namespace isochron::stereo
