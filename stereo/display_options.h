// Options for drawing the eyes' pictures, and the function that draws them.
#pragma once

#include "render/gl/view.h"

#include <glm/vec3.hpp>

#include <functional>
#include <span>

namespace isochron::stereo {

struct DisplayOptions {
    float near_plane = 0.05f, far_plane = 50.0f; ///< [m] along a screen's normal
    glm::vec3 background{0.0f};                  ///< sRGB, 0 to 1
    bool transparent = false;                    ///< there is no background
    int samples = 1; ///< per pixel of an eye; they are resolved before the eyes are composed
    /// Pictures, each moved by part of a pixel, whose mean `Display::draw` makes.
    int passes = 1;
};

/// Draws all eyes of one viewport, in the order of `eyes_of`. Their pictures lie in one target, so
/// that one pass can draw both. The target is bound and cleared to the background; viewport and
/// scissor number i are set for view i.
using DrawViews = std::function<void(std::span<const render::View>)>;
/// Draws a further part of the picture, over what has been drawn before, as DrawViews does.
/// @return whether the picture is complete now
using DrawPart = std::function<bool(std::span<const render::View>)>;

} // namespace isochron::stereo
