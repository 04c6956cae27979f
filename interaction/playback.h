// Playback: finds the step to show as physical time runs; steps may be unevenly spaced.
#pragma once

#include "interaction/commands.h"
#include "interaction/step_track.h"

#include <span>

namespace isochron::interaction {

/// The series lasts from its first to its last time plus one mean step, so that the last step is
/// shown too; at speed 1 that takes 10 s. A step is shown from its own time up to the time of the
/// next one that is shown; blended, it is shown at its own time alone. Playing keeps to its range
/// (`StepTrack`); what is shown at rest does not.
class Playback {
  public:
    struct Result {
        std::uint32_t step;   ///< what to show now
        bool playing;         ///< false while paused, and once an end is reached without `loop`
        bool reverse = false; ///< the direction from now on: `ping_pong` turns at the ends
        std::uint32_t fraction = 0; ///< share of the way to the next step, where steps are blended
    };
    /// Advances physical time by `elapsed` at the speed of `state`. If `step` is not the one that
    /// this object returned last, time continues from `step`. Without `loop`, playing that starts
    /// at its last step starts over from the other end. Fewer than two steps never play.
    /// @param times physical times of the steps, increasing
    /// @param from the moment that is shown
    /// @param blended time is shown between the steps, too, but for these gaps; null: only steps are
    Result advance(std::span<const double> times, const Moment& from, const PlaybackState& state,
                   Seconds elapsed, const StepRange& range = {}, const StepGaps* blended = nullptr);

  private:
    double time_ = 0; ///< on the track
    bool reverse_ = false;
    bool was_playing_ = false;
};

} // namespace isochron::interaction
