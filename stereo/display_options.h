// How the pictures of a display's eyes are drawn, and what draws them.
#pragma once

#include "render/gl/view.h"

#include <glm/vec3.hpp>

#include <functional>
#include <span>

namespace isochron::stereo {

struct DisplayOptions {
    float near_plane = 0.05f, far_plane = 50.0f; ///< [m] along a screen's normal
    glm::vec3 background{0.0f};                  ///< sRGB, 0 to 1
    int samples = 1; ///< of each pixel of an eye, resolved before eyes are composed
};

/// Draws all eyes of one viewport, in the order of `eyes_of`. Their pictures lie in one target, so
/// that a pass may draw them at once. It is bound and cleared to the background, and viewport and
/// scissor number i are those of the i-th view.
using DrawViews = std::function<void(std::span<const render::View>)>;

} // namespace isochron::stereo
