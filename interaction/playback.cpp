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

struct Moment {
    double time;
    bool reverse;
};

/// Goes to and fro: the places between the ends are shown on both ways, the ends once in a round.
Moment swung(const StepTrack& track, const Moment& from, double distance) {
    // One round as a line: all places on the way up, then those between the ends on the way down.
    const double up = track.duration(), top = track.start(track.last());
    const double round = up + top - track.start(1);
    double at = (from.reverse ? up + top - from.time : from.time) + distance;
    at -= round * std::floor(at / round);
    const bool down = at >= up;
    return {std::clamp(down ? up + top - at : at, 0.0, down ? std::nextafter(top, 0.0) : up), down};
}

} // namespace

Playback::Result Playback::advance(std::span<const double> times, std::uint32_t step,
                                   const PlaybackState& state, Seconds elapsed,
                                   const StepRange& range) {
    if (times.empty())
        return {step, false, state.reverse};
    const StepTrack track(times, range, state);
    const double round = track.duration();
    if (!(round > 0.0) || !std::isfinite(round) || track.places() < 2)
        return {step, false, state.reverse};
    step = std::min(step, static_cast<std::uint32_t>(times.size() - 1));
    const std::uint32_t end = state.reverse ? 0 : track.last();
    const bool starts = state.playing && !was_playing_;
    was_playing_ = state.playing;

    const bool turned_at_rest = state.reverse != reverse_ && (starts || !state.playing);
    reverse_ = state.reverse;
    std::uint32_t place = track.place_of(step, state.reverse);
    const bool ends = !state.loop && !state.ping_pong;
    if (starts && ends && place == end) {
        place = track.last() - end;
        time_ = entry(track, place, state.reverse);
    } else if (turned_at_rest || track.place_at(time_) != place) {
        time_ = entry(track, place, state.reverse);
    }
    if (!state.playing)
        return {step, false, state.reverse};

    const double distance = track_rate(state, times) * std::max(elapsed.count(), 0.0);
    if (state.ping_pong) {
        const Moment now = swung(track, {time_, state.reverse}, distance);
        time_ = now.time;
        reverse_ = now.reverse;
        return {track.step(track.place_at(time_)), true, now.reverse};
    }
    time_ += state.reverse ? -distance : distance;
    if (state.loop) {
        time_ -= round * std::floor(time_ / round);
        return {track.step(track.place_at(time_)), true, state.reverse};
    }
    time_ = std::clamp(time_, 0.0, round);
    place = track.place_at(time_);
    return {track.step(place), place != end, state.reverse};
}

} // namespace isochron::interaction
