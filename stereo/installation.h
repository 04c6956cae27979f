// Description of a display installation: windows, their viewports, the screens that these show, and
// the viewers.
#pragma once

#include "interaction/commands.h"
#include "stereo/stereo_mode.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace isochron::stereo {

/// The line of the file that describes something; 0: none does. It makes no difference whether two
/// things are the same.
struct FileLine {
    int number = 0;
    bool operator==(const FileLine&) const { return true; }
};

/// A wall: a rectangle given by three corners [m], in the room frame; or, if the head of the
/// viewport's viewer carries it, in the head's frame (origin between the eyes, -Z ahead).
struct Screen {
    glm::vec3 lower_left{-0.8f, 1.1f, -1.0f};
    glm::vec3 upper_left{-0.8f, 2.0f, -1.0f};
    glm::vec3 upper_right{0.8f, 2.0f, -1.0f};
    bool carried_by_head = false;
    float bezel = 0; ///< [m] of a display's frame, outside of the corners
    /// For desktop windows: enlarge the screen around its middle, in width or height, to the
    /// viewport's aspect.
    bool fit_aspect = false;
    /// Fraction of the picture's width, at its left, that shows what lies left of the screen. The
    /// screen is fitted to the rest. Not configured.
    float aside = 0;
    FileLine line{}; ///< or else of its viewport, or of its window
    bool operator==(const Screen&) const = default;
};

/// Part of a window that shows one screen; fractions of the window, origin at the lower left.
struct Viewport {
    std::string name; ///< name of the wall, for messages and file names; may be empty
    glm::vec2 position{0.0f};
    glm::vec2 size{1.0f};
    std::size_t viewer = 0; ///< who sees it: index into the installation's viewers
    Screen screen;
    /// The display hangs upside down: its pixels show the picture turned by 180 degrees. The screen's
    /// corners are where the viewer sees them.
    bool upside_down = false;
    bool operator==(const Viewport&) const = default;
};

/// Pixels at the edges of a picture that stay free of it, for a panel.
struct Margins {
    int left = 0, top = 0, bottom = 0;
    bool operator==(const Margins&) const = default;
};

inline constexpr int kNextMonitor = -1;

/// How large a window becomes that is framed and not fullscreen.
enum class SizeOnDesktop : std::uint8_t {
    exactly, ///< as it says
    fitting, ///< no larger than the first monitor has room
    scaled   ///< alike, where its size counts pixels of a display with 96 pixels an inch
};

struct Window {
    std::string name = "window"; ///< no two windows share one
    glm::ivec2 size{1280, 720};  ///< pixels
    glm::ivec2 position{-1};     ///< -1: chosen by the desktop
    bool fullscreen = false;
    /// Monitor that a fullscreen window covers, from 0; kNextMonitor: the first that no other
    /// window of the process covers.
    int monitor = kNextMonitor;
    int node = 0;                                 ///< node of a cluster whose process opens it
    bool border = true;                           ///< whether the desktop may frame it
    SizeOnDesktop sized = SizeOnDesktop::exactly; ///< not configured
    StereoMode stereo = StereoMode::mono;
    std::vector<Viewport> viewports{Viewport{}};
    FileLine line{};
    bool operator==(const Window&) const = default;
};

/// Where a viewer's eyes are in the frame of the head: X to the right, Y up, -Z ahead.
struct Eyes {
    /// Eyes that lie on both sides of the head's origin, as most do.
    Eyes(float apart = 0) : separation(apart) {}
    float separation;             ///< [m] from one eye to the other
    glm::vec3 middle{0.0f};       ///< [m] between them
    glm::vec3 across{1.0f, 0, 0}; ///< unit vector from the left eye to the right one
    bool operator==(const Eyes&) const = default;
};

/// A viewer in the room.
struct Viewer {
    std::string name = "viewer";
    std::string head = "head";            ///< the device that tracks the head
    glm::vec3 position{0.0f, 1.6f, 0.0f}; ///< position of the head until it is tracked [m]
    float eye_separation = 0.063f;        ///< meters, 0 to 0.1
    /// Measured places of the eyes in the head's frame [m], `eye_separation` apart; both or none.
    std::optional<glm::vec3> left_eye, right_eye;
    FileLine line{};
    bool operator==(const Viewer&) const = default;
};

struct Installation {
    std::vector<Viewer> viewers{Viewer{}};       ///< at least one
    std::vector<Window> windows{Window{}};       ///< at least one, each with at least one viewport
    float near_plane = 0.05f, far_plane = 50.0f; ///< meters
    bool operator==(const Installation&) const = default;
};

/// The stereo mode of a window when the user has chosen `live`: windows with the same configured
/// mode as the first one follow the choice, others (an operator's monitor) keep their own mode.
inline StereoMode mode_of(const Window& window, const Installation& installation, StereoMode live) {
    return window.stereo == installation.windows.front().stereo ? live : window.stereo;
}

/// A viewer's eye separation [m] when the user has chosen `live` for the first viewer. The eye
/// separations of the other viewers change in proportion, so that 0 makes all of them 0.
inline float eye_separation_of(const Viewer& viewer, const Installation& installation, float live) {
    const float first = installation.viewers.front().eye_separation;
    if (first == viewer.eye_separation || first <= 0.0f)
        return live;
    return std::min(viewer.eye_separation * (live / first), interaction::kWidestEyes);
}

/// A viewer's eyes when they are this far apart [m]: both move along their line from the middle.
inline Eyes eyes_of_viewer(const Viewer& viewer, float separation) {
    Eyes eyes(separation);
    if (!viewer.left_eye || !viewer.right_eye)
        return eyes;
    eyes.middle = 0.5f * (*viewer.left_eye + *viewer.right_eye);
    const glm::vec3 across = *viewer.right_eye - *viewer.left_eye;
    if (const float apart = glm::length(across); apart > 0)
        eyes.across = across / apart;
    return eyes;
}

} // namespace isochron::stereo
