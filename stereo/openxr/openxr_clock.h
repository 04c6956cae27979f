// Session time of an OpenXR runtime's times.
#pragma once

#include "interaction/pose.h"

#include <openxr/openxr.h>

namespace isochron::stereo {

class OpenXrInstance;

/// The two clocks are compared once in every frame, so that they cannot drift apart. A runtime
/// without XR_KHR_convert_timespec_time tells no time but that of the next picture: then a frame is
/// taken to be seen one period after the program was told of it.
class OpenXrClock {
  public:
    explicit OpenXrClock(const OpenXrInstance& instance);

    /// @param now session time of this very moment
    void compare(const OpenXrInstance& instance, interaction::Seconds now);
    /// @param now session time, right after xrWaitFrame has told of the frame
    void told(XrTime display_time, XrDuration period, interaction::Seconds now);

    interaction::Seconds session_time(XrTime time) const;

  private:
    PFN_xrVoidFunction convert_ = nullptr;
    XrTime here_ = 0; ///< at `now_`
    interaction::Seconds now_{0};
};

} // namespace isochron::stereo
