// Description of a display installation: windows, their viewports, the screens behind them, and the
// viewers before them.
#pragma once

#include "interaction/commands.h"
#include "stereo/stereo_mode.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace isochron::stereo {

/// A wall: a rectangle given by three corners, meters. Room frame, or, when carried by the head of
/// the viewport's viewer, that head's frame (origin between the eyes, -Z ahead).
struct Screen {
    glm::vec3 lower_left{-0.8f, 1.1f, -1.0f};
    glm::vec3 upper_left{-0.8f, 2.0f, -1.0f};
    glm::vec3 upper_right{0.8f, 2.0f, -1.0f};
    bool carried_by_head = false;
    /// Widen or heighten the screen about its middle to the viewport's aspect (desktop windows), so
    /// that what the screen shows stays in view.
    bool fit_aspect = false;
    /// Of the picture's width, from its left: shows what is beside the screen, which is fitted to
    /// the rest. Not configured.
    float aside = 0;
    bool operator==(const Screen&) const = default;
};

/// Part of a window that shows one screen; fractions of the window, origin at the lower left.
struct Viewport {
    std::string name; ///< of the wall, for messages and file names; may be empty
    glm::vec2 position{0.0f};
    glm::vec2 size{1.0f};
    std::size_t viewer = 0; ///< whose eyes see it: index into the installation's viewers
    Screen screen;
    bool operator==(const Viewport&) const = default;
};

inline constexpr int kNextMonitor = -1;

struct Window {
    std::string name = "window"; ///< no two windows share one
    glm::ivec2 size{1280, 720};  ///< pixels
    glm::ivec2 position{-1};     ///< -1: wherever the desktop puts it
    bool fullscreen = false;
    /// That a fullscreen window covers, from 0; kNextMonitor: the first one free in its process.
    int monitor = kNextMonitor;
    int node = 0;       ///< of a cluster, whose process opens it
    bool border = true; ///< whether the desktop may frame it
    StereoMode stereo = StereoMode::mono;
    std::vector<Viewport> viewports{Viewport{}};
    bool operator==(const Window&) const = default;
};

/// Somebody who stands in the room.
struct Viewer {
    std::string name = "viewer";
    std::string head = "head";            ///< the device that tracks the head
    glm::vec3 position{0.0f, 1.6f, 0.0f}; ///< of the head, until a device tells, meters
    float eye_separation = 0.063f;        ///< meters, 0 to 0.1
    bool operator==(const Viewer&) const = default;
};

struct Installation {
    std::vector<Viewer> viewers{Viewer{}};       ///< at least one
    std::vector<Window> windows{Window{}};       ///< at least one, each with at least one viewport
    float near_plane = 0.05f, far_plane = 50.0f; ///< meters
    bool operator==(const Installation&) const = default;
};

/// The stereo mode that a window shows when the live choice is `live`: windows that are configured
/// like the first one follow the choice, others (an operator's monitor) keep their own.
inline StereoMode mode_of(const Window& window, const Installation& installation, StereoMode live) {
    return window.stereo == installation.windows.front().stereo ? live : window.stereo;
}

/// A viewer's eye separation when the live choice, which is that of the first viewer, is `live`
/// [m]: everyone's eyes move in proportion, so that 0 brings all of them together.
inline float eye_separation_of(const Viewer& viewer, const Installation& installation, float live) {
    const float first = installation.viewers.front().eye_separation;
    if (first == viewer.eye_separation || first <= 0.0f)
        return live;
    return std::min(viewer.eye_separation * (live / first), interaction::kWidestEyes);
}

} // namespace isochron::stereo
