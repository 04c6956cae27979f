// The steps that playing shows next.
#include "app/frame/steps_ahead.h"

#include "interaction/step_track.h"

namespace isochron::app {

std::optional<index::StepsAhead> steps_ahead(index::Instant now,
                                             const interaction::Settings& settings,
                                             std::span<const double> times) {
    const interaction::PlaybackState& playback = settings.playback;
    if (now.between()) { // both of its steps are at hand: the next one is read meanwhile
        const std::uint32_t after = playback.reverse ? now.step - 1 : now.step + 2; // wraps below 0
        return after < times.size() ? std::optional(index::StepsAhead{.next = after})
                                    : std::nullopt;
    }
    const interaction::StepTrack track(times, settings.play_range, playback);
    if (track.places() < 2)
        return std::nullopt;
    const std::uint32_t place = track.place_of(now.step, playback.reverse), last = track.last();
    const bool turns = playback.ping_pong && place == (playback.reverse ? 0 : last);
    const bool reverse = playback.reverse != turns;
    return index::StepsAhead{.next = (place + (reverse ? last : 1)) % track.places(),
                             .steps = track.places(),
                             .reverse = reverse,
                             .to_and_fro = playback.ping_pong,
                             .first = track.step(0),
                             .every = track.step(1) - track.step(0)};
}

} // namespace isochron::app
