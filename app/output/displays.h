// The displays of a configured installation, one for each window.
#pragma once

#include "app/config/config.h"
#include "stereo/display.h"
#include "stereo/windows.h"

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// Options that all displays of this configuration share.
/// @throws render::Error when this GL has fewer samples than configured, or a limit too small for
/// drawing (`render::expect_enough`)
stereo::DisplayOptions display_options(const render::Gl& gl, const Config& config);

/// Samples of each pixel of a settled picture in a window.
inline constexpr int kSettledSamples = 16;

/// The options for a capture.
/// @param window size of the picture's window, pixels
/// @throws render::Error when this GL has fewer samples than configured for pictures
stereo::DisplayOptions picture_options(const render::Gl& gl, const Config& config,
                                       glm::ivec2 window);

/// A display for each window, in a deque as displays must not move.
/// @throws render::Error when this GL has fewer samples than configured
std::deque<stereo::Display> make_displays(const render::Gl& gl, const stereo::Windows& windows,
                                          const Config& config);

/// Names of the modes that a key switches through: those that the windows can show, without
/// inverted ones.
std::vector<std::string> live_stereo_modes(const stereo::Windows& windows);

/// Where the eyes are: at each viewer's head, or at the configured position until it is tracked.
/// @param eye_separation of the first viewer, as the user has set it [m]
/// @param center of the data in the room, if desktop screens use parallel projection
std::vector<stereo::ViewerPose> viewer_poses(const stereo::Installation& installation,
                                             const interaction::InputState& input,
                                             float eye_separation,
                                             const std::optional<glm::dvec3>& center = {});

} // namespace isochron::app
