// Playback: finds the step to show as physical time runs; steps may be unevenly spaced.
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
        bool playing;       ///< false while paused, and once an end is reached without `loop`
    };
    /// Advances physical time by `elapsed` at the speed of `state`. If `step` is not the one that
    /// this object returned last, time continues from `step`. Without `loop`, playing that starts
    /// at its last step starts over from the other end. Fewer than two steps never play.
    /// @param times physical times of the steps, increasing
    Result advance(std::span<const double> times, std::uint32_t step, const PlaybackState& state,
                   Seconds elapsed);

  private:
    double cursor_ = 0; ///< physical time since the first step
    bool reverse_ = false;
    bool was_playing_ = false;
};

inline constexpr double kRoundSeconds = 10.0; ///< [s] of one whole series at speed 1

/// Physical duration of one round: last minus first time plus one mean step; 0 for one step.
double period(std::span<const double> times);

} // namespace isochron::interaction
