// Description of a display installation: windows, their viewports, and the screens behind them.
#pragma once

#include "stereo/stereo_mode.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <string>
#include <vector>

namespace isochron::stereo {

/// A wall: a rectangle given by three corners, metres. Room frame, or, when carried by the head,
/// the head's frame (origin between the eyes, -Z ahead).
struct Screen {
    glm::vec3 lower_left{-0.8f, 1.1f, -1.0f};
    glm::vec3 upper_left{-0.8f, 2.0f, -1.0f};
    glm::vec3 upper_right{0.8f, 2.0f, -1.0f};
    bool carried_by_head = false;
    /// Widen or heighten the screen about its middle to the viewport's aspect (desktop windows), so
    /// that what the screen shows stays in view.
    bool fit_aspect = false;
};

/// Part of a window that shows one screen; fractions of the window, origin at the lower left.
struct Viewport {
    glm::vec2 position{0.0f};
    glm::vec2 size{1.0f};
    Screen screen;
};

struct Window {
    std::string name = "window";
    glm::ivec2 size{1280, 720}; ///< pixels
    glm::ivec2 position{-1};    ///< -1: wherever the desktop puts it
    bool fullscreen = false;
    int monitor = 0;
    StereoMode stereo = StereoMode::mono;
    std::vector<Viewport> viewports{Viewport{}};
};

struct Installation {
    std::vector<Window> windows{Window{}};
    float eye_separation = 0.063f;               ///< metres, 0 to 0.1
    float near_plane = 0.05f, far_plane = 50.0f; ///< metres
};

} // namespace isochron::stereo
