// Converts an OpenXR runtime's times to session time.
#pragma once

#include "interaction/pose.h"

#include <openxr/openxr.h>

namespace isochron::stereo {

class OpenXrInstance;

/// The two clocks are compared once in every frame, so that they cannot drift apart. A runtime
/// without XR_KHR_convert_timespec_time tells only the time of the next picture: then the program
/// assumes that a frame is visible one period after xrWaitFrame has returned.
class OpenXrClock {
  public:
    explicit OpenXrClock(const OpenXrInstance& instance);

    /// Compares the clocks. @param now current session time
    void compare(const OpenXrInstance& instance, interaction::Seconds now);
    /// Call right after xrWaitFrame. @param now session time
    void told(XrTime display_time, XrDuration period, interaction::Seconds now);

    interaction::Seconds session_time(XrTime time) const;

  private:
    PFN_xrVoidFunction convert_ = nullptr;
    XrTime here_ = 0; ///< at `now_`
    interaction::Seconds now_{0};
};

} // namespace isochron::stereo
