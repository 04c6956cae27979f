// Options for a headset through OpenXR.
#pragma once

#include "interaction/pose.h"

#include <cstdint>

namespace isochron::stereo {

/// The reference space that gives the room's floor and middle.
enum class OpenXrSpace : std::uint8_t {
    automatic, ///< the stage if there is one, else local
    stage,     ///< only the stage
    local      ///< the wearer's place when the runtime was centered becomes the viewer's place
};

/// How the GL context is passed to the runtime.
enum class OpenXrBinding : std::uint8_t {
    automatic, ///< as context and runtime need it
    egl,       ///< XR_MNDX_egl_enable
    xlib       ///< XR_KHR_opengl_enable with GLX
};

struct OpenXrOptions {
    OpenXrSpace space = OpenXrSpace::automatic;
    OpenXrBinding binding = OpenXrBinding::automatic;
    bool wait = false;       ///< without a runtime, look for one until it appears
    bool windowless = false; ///< the context will be one of EGL without a window
    bool depth = true;       ///< send depth with the picture if the runtime takes it
    bool left_handed = false;
    float scale = 1.0f;                       ///< relative to the recommended size of each side
    float near_plane = 0.05f, far_plane = 50; ///< [m] for depths 0 and 1
    interaction::Pose local_in_room;          ///< place of the head in the room without a stage
    interaction::Seconds retry{2.0};          ///< between attempts to find a runtime or headset
};

} // namespace isochron::stereo
