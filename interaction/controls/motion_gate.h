// Decides when the picture may be slow and exact: when viewer and data are still.
#pragma once

#include "interaction/commands.h"
#include "interaction/input/tracked_input.h"

#include <memory>

namespace isochron::interaction {

enum class Pace : std::uint8_t { moving, settled };
/// `moving`, `settled`.
const char* name_of(Pace pace);

/// Tracked motion below these speeds counts as tremor, not as intended.
struct StillnessLimits {
    float linear = 0.02f;      ///< [m/s], room space
    float angular = 0.05f;     ///< [rad/s]
    float leave_factor = 3.0f; ///< `settled` is left above this multiple of the limits
    Seconds settle{0.150};     ///< how long everything must be still before `settled`
};

/// How a picture moves while time plays: all the time, or with each step, so that a step that is
/// shown for long may settle.
enum class Playing : std::uint8_t { moves, moves_by_steps };

/// `settled`: no button is down, no valuator is off rest, no command changes isovalue, surfaces,
/// step, playback or the data's place, time does not play, and the head has been still for long
/// enough; while time plays by steps, a tenth of a second since the last step is enough. A wand's buttons and valuators count, its motion alone does not. The `quiet_actions`
/// (screenshot, stamp, panel, modifiers, ...) do not count. Head speeds are estimated over a
/// window, so that tracker noise is not taken for motion; an invalid head pose counts as still.
class MotionGate {
  public:
    explicit MotionGate(const StillnessLimits& limits);
    ~MotionGate();
    /// Advances by one frame.
    /// @param commands all commands of this frame's devices and panel; in the first frame also the
    ///        start state, since the gate learns only from commands whether time plays
    Pace update(const InputState& input, const Commands& commands, QualityMode mode,
                Playing playing = Playing::moves);
    Pace pace() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace isochron::interaction
