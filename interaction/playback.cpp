// Playback: finds the step to show as physical time runs.
#include "interaction/playback.h"

#include <algorithm>
#include <cmath>

namespace isochron::interaction {
namespace {

/// The time at which playing enters a place: its beginning, or in reverse its end.
double entry(const StepTrack& track, std::uint32_t place, bool reverse) {
    return reverse ? std::nextafter(track.start(place + 1), 0.0) : track.start(place);
}

struct Way {
    double time;
    bool reverse;
};

/// Goes to and fro: the places between the ends are shown on both ways, the ends once in a round.
/// @param to_start the way down goes to the time at which the track begins
Way swung(const StepTrack& track, const Way& from, double distance, bool to_start) {
    // One round as a line: all places on the way up, then those between the ends on the way down.
    const double up = track.duration(), top = track.start(track.last());
    const double round = up + top - (to_start ? 0.0 : track.start(1));
    double at = (from.reverse ? up + top - from.time : from.time) + distance;
    at -= round * std::floor(at / round);
    const bool down = at >= up;
    return {std::clamp(down ? up + top - at : at, 0.0, down ? std::nextafter(top, 0.0) : up), down};
}

} // namespace

Playback::Result Playback::advance(std::span<const double> times, const Instant& from,
                                   const PlaybackState& state, Seconds elapsed,
                                   const StepRange& range, const StepGaps* blended) {
    const auto stays = [&](std::uint32_t step) {
        return Result{{step, from.fraction}, false, state.reverse};
    };
    if (times.empty())
        return stays(from.step);
    const StepTrack track(times, range, state);
    const double round = track.duration();
    if (!(round > 0.0) || !std::isfinite(round) || track.places() < 2)
        return stays(from.step);
    const std::uint32_t step = std::min(from.step, static_cast<std::uint32_t>(times.size() - 1));
    const std::uint32_t end = state.reverse ? 0 : track.last();
    const bool starts = state.playing && !was_playing_;
    was_playing_ = state.playing;
    const bool blends = blended && state.every == 1;

    const bool turned_at_rest = state.reverse != reverse_ && (starts || !state.playing);
    reverse_ = state.reverse;
    std::uint32_t place = track.place_of(step, state.reverse);
    const bool ends = !state.loop && !state.ping_pong;
    const bool at_end = place == end && (!blends || !state.reverse || from.fraction == 0);
    if (starts && ends && at_end) {
        place = track.last() - end;
        time_ = blends ? track.start(place) : entry(track, place, state.reverse);
    } else if (blends) {
        const Instant at(step, from.fraction);
        if (track.instant_at(time_, *blended) != at)
            time_ = track.time_of(at, state.reverse);
    } else if (turned_at_rest || track.place_at(time_) != place) {
        time_ = entry(track, place, state.reverse);
    }
    if (!state.playing)
        return stays(step);

    const auto shown = [&](bool playing, bool reverse) {
        const Instant now =
            blends ? track.instant_at(time_, *blended) : Instant(track.step(track.place_at(time_)));
        return Result{now, playing, reverse};
    };
    const double distance = track_rate(state, times) * std::max(elapsed.count(), 0.0);
    if (state.ping_pong) {
        const Way now = swung(track, {time_, state.reverse}, distance, blends);
        time_ = now.time;
        reverse_ = now.reverse;
        return shown(true, now.reverse);
    }
    time_ += state.reverse ? -distance : distance;
    if (state.loop) {
        time_ -= round * std::floor(time_ / round);
        return shown(true, state.reverse);
    }
    time_ = std::clamp(time_, 0.0, round);
    const bool goes_on = blends && state.reverse ? time_ > 0.0 : track.place_at(time_) != end;
    return shown(goes_on, state.reverse);
}

} // namespace isochron::interaction
