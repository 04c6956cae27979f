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

/// What displays of this configuration have alike.
/// @throws render::Error when this GL has fewer samples than configured, or too little of anything
/// that drawing needs (`render::expect_enough`)
stereo::DisplayOptions display_options(const render::Gl& gl, const Config& config);

/// The same for a picture to keep.
/// @param window its size, pixels
/// @throws render::Error when this GL has fewer samples than configured for pictures
stereo::DisplayOptions picture_options(const render::Gl& gl, const Config& config,
                                       glm::ivec2 window);

/// One for each window; a display stays where it is made.
/// @throws render::Error when this GL has fewer samples than configured
std::deque<stereo::Display> make_displays(const render::Gl& gl, const stereo::Windows& windows,
                                          const Config& config);

/// The modes that a key goes through: upright ones that the windows can show.
std::vector<std::string> live_stereo_modes(const stereo::Windows& windows);

/// Where the eyes are: each viewer's head, or until it is tracked the configured place.
/// @param eye_separation chosen live, of the first viewer [m]
/// @param center of the data in the room, where desktop screens show them in parallel projection
std::vector<stereo::ViewerPose> viewer_poses(const stereo::Installation& installation,
                                             const interaction::InputState& input,
                                             float eye_separation,
                                             const std::optional<glm::dvec3>& center = {});

} // namespace isochron::app
