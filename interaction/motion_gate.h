// Decides when the picture may be slow and exact.
#pragma once

#include "interaction/commands.h"
#include "interaction/tracked_input.h"

#include <memory>

namespace isochron::interaction {

enum class Pace : std::uint8_t { moving, settled };
/// `moving`, `settled`.
const char* name_of(Pace pace);

/// Below these speeds, tracked motion is tremor rather than intent.
struct StillnessLimits {
    float linear = 0.02f;      ///< [m/s], room space
    float angular = 0.05f;     ///< [rad/s]
    float leave_factor = 3.0f; ///< `settled` is left above this multiple of the limits
    Seconds settle{0.150};     ///< uninterrupted stillness required
};

/// `settled` = no button, valuator, isovalue or time event pending, time not playing, and the head
/// still for long enough. A wand's buttons and valuators count, its motion alone does not; nor do
/// keys that leave the picture as it is (screenshot, stamp, panel, modifiers). Head speeds are
/// estimated over a window, so that tracker noise is not taken for motion; an invalid head pose is
/// held and counts as still.
class MotionGate {
  public:
    explicit MotionGate(const StillnessLimits& limits);
    ~MotionGate();
    /// Advances by one frame.
    /// @param commands all that this frame's devices and panel led to; in the first frame also the
    ///        start state, as `playback` is remembered from here
    Pace update(const InputState& input, const Commands& commands, QualityMode mode);
    Pace pace() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace isochron::interaction
