// The steps that playing goes through, and when each of them is shown.
#include "interaction/step_track.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace isochron::interaction {
namespace {

double valid(double rate, double low, double high) {
    return rate > 0.0 ? std::clamp(rate, low, high) : 1.0;
}

} // namespace

StepTrack::StepTrack(std::span<const double> times, const StepRange& range,
                     const PlaybackState& state)
    : times_(times), every_(std::clamp(state.every, 1u, kMostSkipped)),
      evenly_(state.unit == SpeedUnit::steps) {
    const auto steps = static_cast<std::uint32_t>(times.size());
    first_ = first_of(range, steps);
    places_ = (last_of(range, steps) - first_) / every_ + 1;
}

std::uint32_t StepTrack::place_of(std::uint32_t at, bool reverse) const {
    if (at < first_ || at - first_ >= places_ * every_)
        return reverse ? last() : 0;
    const std::uint32_t past = at - first_;
    return std::min((past + (reverse ? 0 : every_ - 1)) / every_, last());
}

double StepTrack::start(std::uint32_t place) const {
    if (evenly_)
        return std::min(place, places_);
    const double span = times_[step(last())] - times_[first_];
    if (place >= places_)
        return places_ < 2 ? 0.0 : span + span / static_cast<double>(last());
    return times_[step(place)] - times_[first_];
}

std::uint32_t StepTrack::place_at(double time) const {
    std::uint32_t low = 0, high = places_; // the first place that begins after `time`
    while (low < high) {
        const std::uint32_t middle = low + (high - low) / 2;
        if (start(middle) <= time)
            low = middle + 1;
        else
            high = middle;
    }
    return std::max(low, 1u) - 1;
}

Instant StepTrack::instant_at(double time, const StepGaps& gaps) const {
    const std::uint32_t place = place_at(time), at = step(place);
    if (place >= last() || every_ != 1 || gaps.behind(at))
        return Instant(at);
    const double begin = start(place);
    const double share = std::clamp((time - begin) / (start(place + 1) - begin), 0.0, 1.0);
    const auto fraction = static_cast<std::uint32_t>(std::lround(share * Instant::kFractions));
    return fraction == Instant::kFractions ? Instant(at + 1) : Instant(at, fraction);
}

double StepTrack::time_of(Instant at, bool reverse) const {
    const std::uint32_t place = place_of(at.step, reverse);
    if (step(place) != at.step || place >= last())
        return start(place);
    return std::lerp(start(place), start(place + 1),
                     static_cast<double>(at.fraction) / Instant::kFractions);
}

double period(std::span<const double> times) {
    if (times.size() < 2)
        return 0.0;
    const double span = times.back() - times.front();
    return span + span / static_cast<double>(times.size() - 1);
}

double track_rate(const PlaybackState& state, std::span<const double> times) {
    return state.unit == SpeedUnit::series
               ? valid(state.speed, kSlowest, kFastest) * period(times) / kRoundSeconds
               : valid(state.rate, kSlowestRate, kFastestRate);
}

std::uint32_t next_step(std::uint32_t step, const PlaybackState& state, std::uint32_t steps) {
    const std::uint32_t last = steps - 1, every = std::max(state.every, 1u);
    if (last - std::min(step, last) >= every)
        return step + every;
    return state.loop ? 0 : last;
}

std::uint32_t previous_step(Instant now, const PlaybackState& state, std::uint32_t steps) {
    const std::uint32_t last = steps - 1, every = std::max(state.every, 1u), step = now.step;
    if (now.within(steps).between())
        return step;
    if (step >= every)
        return std::min(step - every, last);
    return state.loop ? last - last % every : 0;
}

std::uint32_t first_of(const StepRange& range, std::uint32_t steps) {
    return std::min(range.first.value_or(0), steps - 1);
}

std::uint32_t last_of(const StepRange& range, std::uint32_t steps) {
    const std::uint32_t last = std::min(range.last.value_or(steps - 1), steps - 1);
    return std::max(last, first_of(range, steps));
}

StepRange begun_at(std::uint32_t step, StepRange range) {
    if (range.first == step) {
        range.first.reset();
    } else {
        range.first = step;
        if (range.last && *range.last < step)
            range.last.reset();
    }
    return range;
}

StepRange ended_at(std::uint32_t step, StepRange range) {
    if (range.last == step) {
        range.last.reset();
    } else {
        range.last = step;
        if (range.first && *range.first > step)
            range.first.reset();
    }
    return range;
}

StepRange marked_at(std::uint32_t step, const StepRange& range) {
    if (range.last || range.first == step)
        return {};
    return !range.first || step < *range.first ? StepRange{step, {}} : StepRange{range.first, step};
}

std::optional<Instant> next_bookmark(std::span<const Bookmark> bookmarks, Instant now,
                                     bool blends) {
    if (!blends)
        now.fraction = kMostFraction;
    std::optional<Instant> first, next;
    for (const Bookmark& each : bookmarks) {
        first = std::min(first.value_or(each.instant), each.instant);
        if (each.instant > now)
            next = std::min(next.value_or(each.instant), each.instant);
    }
    return next ? next : first;
}

std::optional<Instant> previous_bookmark(std::span<const Bookmark> bookmarks, Instant now,
                                         bool blends) {
    if (!blends)
        now.fraction = 0;
    std::optional<Instant> last, previous;
    for (const Bookmark& each : bookmarks) {
        last = std::max(last.value_or(each.instant), each.instant);
        if (each.instant < now)
            previous = std::max(previous.value_or(each.instant), each.instant);
    }
    return previous ? previous : last;
}

std::vector<Bookmark> toggled_bookmark(std::vector<Bookmark> bookmarks, Instant at) {
    if (std::erase_if(bookmarks, [&](const Bookmark& each) { return each.instant == at; }) > 0 ||
        bookmarks.size() == kMostBookmarks)
        return bookmarks;
    const auto after =
        std::ranges::find_if(bookmarks, [&](const Bookmark& each) { return each.instant > at; });
    bookmarks.insert(after, {name_of(at), at});
    return bookmarks;
}

std::string name_of(Instant at) {
    if (at.fraction == 0)
        return fmt::format("step {}", at.step + 1);
    return fmt::format("step {:.2f}",
                       at.step + 1 + static_cast<double>(at.fraction) / Instant::kFractions);
}

PlaybackState counted_in(SpeedUnit unit, PlaybackState state, std::span<const double> times) {
    const double round = period(times);
    if (unit == state.unit || !(round > 0) || !std::isfinite(round))
        return state;
    const double apart = round / static_cast<double>(times.size()) * state.every; // pictures
    double time = state.rate; // units of the data's time a second
    if (state.unit == SpeedUnit::series)
        time = state.speed * round / kRoundSeconds;
    else if (state.unit == SpeedUnit::steps)
        time = state.rate * apart;
    if (unit == SpeedUnit::series)
        state.speed = std::clamp(time * kRoundSeconds / round, kSlowest, kFastest);
    else
        state.rate =
            std::clamp(unit == SpeedUnit::steps ? time / apart : time, kSlowestRate, kFastestRate);
    state.unit = unit;
    return state;
}

PlaybackState sped_up(PlaybackState state, double factor) {
    if (state.unit == SpeedUnit::series)
        state.speed = std::clamp(state.speed * factor, kSlowest, kFastest);
    else
        state.rate = std::clamp(state.rate * factor, kSlowestRate, kFastestRate);
    return state;
}

} // namespace isochron::interaction
