// The controls of time: playing, steps, the range that is played, bookmarks.
#pragma once

#include "interaction/control_context.h"
#include "interaction/controls/key_repeat.h"
#include "interaction/input/device_reading.h"
#include "interaction/playback.h"

#include <string>
#include <vector>

namespace isochron::interaction {

class TimeControls {
  public:
    /// Sets `step`, `playback`, `follow`, `play_range` and `bookmarks` if they change.
    /// @param elapsed time that plays
    void update(const Reading& now, const ControlContext& context, Seconds time, Seconds elapsed,
                Commands& commands, std::vector<std::string>& notes);

  private:
    Instant moved(const Reading& now, const ControlContext& context, Seconds time,
                  std::uint32_t steps);
    Instant pushed(const Reading& now, const ControlContext& context, const Instant& from,
                   Seconds elapsed);

    KeyRepeat forward_, back_;
    Playback playback_;
    Playback pushed_; ///< how far the wand has pushed time on
};

} // namespace isochron::interaction
