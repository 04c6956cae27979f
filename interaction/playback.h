// Which step is shown as physical time runs: steps may be unevenly spaced.
#pragma once

#include "interaction/commands.h"

#include <span>

namespace isochron::interaction {

/// The series lasts from its first to its last time plus one mean step, so that the last step is
/// shown too; at speed 1 that takes 10 s. A step is shown from its own time up to the next one's.
class Playback {
  public:
    struct Result {
        std::uint32_t step; ///< what to show now
        bool playing;       ///< false once an end was reached without `loop`
    };
    /// Advances by `elapsed` from where time stands. When `step` is not what this object last
    /// returned, time continues from that step. Playing that starts at the end it runs towards,
    /// without `loop`, starts over from the other end. Fewer than two steps never play.
    /// @param times physical times of the steps, increasing
    Result advance(std::span<const double> times, std::uint32_t step, const PlaybackState& state,
                   Seconds elapsed);

  private:
    double cursor_ = 0; ///< physical time since the first step
    bool reverse_ = false;
    bool was_playing_ = false;
};

inline constexpr double kRoundSeconds = 10.0; ///< of one whole series at speed 1

/// Physical duration of one round: last minus first time plus one mean step; 0 for one step.
double period(std::span<const double> times);

} // namespace isochron::interaction
