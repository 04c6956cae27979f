// What may be chosen about a headset that is shown through OpenXR.
#pragma once

#include "interaction/pose.h"

#include <cstdint>

namespace isochron::stereo {

/// Where the room's floor and middle come from.
enum class OpenXrSpace : std::uint8_t {
    automatic, ///< the stage where there is one, else local
    stage,     ///< the stage alone
    local      ///< where the wearer was when the runtime was centered, at the viewer's place
};

/// How the GL context is handed to the runtime.
enum class OpenXrBinding : std::uint8_t {
    automatic, ///< as context and runtime have it
    egl,       ///< XR_MNDX_egl_enable
    xlib       ///< XR_KHR_opengl_enable with GLX
};

struct OpenXrOptions {
    OpenXrSpace space = OpenXrSpace::automatic;
    OpenXrBinding binding = OpenXrBinding::automatic;
    bool wait = false;       ///< without a runtime it is looked for until there is one
    bool windowless = false; ///< the context will be one of EGL without a window
    bool depth = true;       ///< depth goes along with the picture where the runtime takes it
    bool left_handed = false;
    float scale = 1.0f;                       ///< of each side of the recommended picture
    float near_plane = 0.05f, far_plane = 50; ///< [m] that the depths stand for
    interaction::Pose local_in_room;          ///< the head's place where there is no stage
    interaction::Seconds retry{2.0};          ///< between two looks for a lost runtime or headset
};

} // namespace isochron::stereo
