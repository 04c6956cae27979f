// Playback: finds the step to show as physical time runs.
#include "interaction/playback.h"

#include <algorithm>
#include <cmath>

namespace isochron::interaction {
namespace {

std::uint32_t step_at(std::span<const double> times, double cursor) {
    const auto after = std::ranges::partition_point(
        times, [&](double time) { return time - times.front() <= cursor; });
    return static_cast<std::uint32_t>(std::max<std::ptrdiff_t>(after - times.begin(), 1) - 1);
}

/// The time at which playback enters `step`: its beginning, or in reverse its end.
double entry(std::span<const double> times, std::uint32_t step, bool reverse) {
    if (!reverse)
        return times[step] - times.front();
    const double end = step + 1 < times.size() ? times[step + 1] - times.front() : period(times);
    return std::nextafter(end, 0.0);
}

double valid_speed(double speed) {
    return speed > 0.0 ? std::clamp(speed, kSlowest, kFastest) : 1.0;
}

} // namespace

double period(std::span<const double> times) {
    if (times.size() < 2)
        return 0.0;
    const double span = times.back() - times.front();
    return span + span / static_cast<double>(times.size() - 1);
}

Playback::Result Playback::advance(std::span<const double> times, std::uint32_t step,
                                   const PlaybackState& state, Seconds elapsed) {
    const double round = period(times);
    if (!(round > 0.0) || !std::isfinite(round))
        return {step, false};
    const auto last = static_cast<std::uint32_t>(times.size() - 1);
    step = std::min(step, last);
    const std::uint32_t end = state.reverse ? 0 : last;
    const bool starts = state.playing && !was_playing_;
    was_playing_ = state.playing;

    const bool turned_at_rest = state.reverse != reverse_ && (starts || !state.playing);
    reverse_ = state.reverse;
    if (starts && !state.loop && step == end) {
        step = last - end;
        cursor_ = entry(times, step, state.reverse);
    } else if (turned_at_rest || step_at(times, cursor_) != step) {
        cursor_ = entry(times, step, state.reverse);
    }
    if (!state.playing)
        return {step, false};

    const double distance =
        valid_speed(state.speed) * round / kRoundSeconds * std::max(elapsed.count(), 0.0);
    cursor_ += state.reverse ? -distance : distance;
    if (state.loop) {
        cursor_ -= round * std::floor(cursor_ / round);
        return {step_at(times, cursor_), true};
    }
    cursor_ = std::clamp(cursor_, 0.0, round);
    step = step_at(times, cursor_);
    return {step, step != end};
}

} // namespace isochron::interaction
