// For whom a picture is drawn: the viewers, their stereo mode, and their wand and panel in the
// room.
#pragma once

#include "app/scene/shown_panel.h"
#include "interaction/pose.h"
#include "stereo/display.h"
#include "stereo/headset.h"
#include "stereo/stereo_mode.h"

#include <optional>
#include <vector>

namespace isochron::app {

/// The viewers of one frame.
struct Audience {
    std::vector<stereo::ViewerPose> viewers; ///< by number
    std::vector<stereo::HeadsetEye> eyes;    ///< eyes of a headset that wants a picture
    std::optional<interaction::Pose> wand;   ///< where it is shown
    std::optional<ShownPanel> panel;         ///< the panel that stands in the room
    stereo::StereoMode stereo{};             ///< chosen live
    /// A wand's ray, or the value under a cursor, is shown; captures leave these out.
    bool aids = false;
    /// The window's background is lifted; captures have the background that was asked for.
    bool lifted = false;
    bool in_windows = true; ///< false: a headset shows them, and the first window mirrors it
    bool operator==(const Audience&) const = default;
};

} // namespace isochron::app
