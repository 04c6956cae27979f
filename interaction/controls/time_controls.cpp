// The controls of time: playing, steps, the range that is played, bookmarks.
#include "interaction/controls/time_controls.h"

#include "interaction/navigation/story.h"
#include "interaction/step_track.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace isochron::interaction {
namespace {

/// What keys and buttons make of how time plays; the direction and the step are elsewhere.
PlaybackState chosen(const Reading& now, PlaybackState state, std::span<const double> times) {
    if (now.pressed(Action::play) || now.pressed(GamepadButton::a))
        state.playing = !state.playing;
    if (now.pressed(Action::reverse) || now.pressed(GamepadButton::b))
        state.reverse = !state.reverse;
    if (now.pressed(Action::loop))
        state.loop = !state.loop;
    if (now.pressed(Action::ping_pong))
        state.ping_pong = !state.ping_pong;
    if (now.pressed(Action::faster))
        state = sped_up(state, 2);
    if (now.pressed(Action::slower))
        state = sped_up(state, 0.5);
    if (now.pressed(Action::skip_more))
        state.every = std::min(state.every + 1, kMostSkipped);
    if (now.pressed(Action::skip_fewer))
        state.every = std::max(state.every, 2u) - 1;
    if (now.pressed(Action::speed_unit)) {
        const auto next = static_cast<std::size_t>(state.unit) + 1;
        state = counted_in(static_cast<SpeedUnit>(next % kNames<SpeedUnit>.size()), state, times);
    }
    return state;
}

StepRange chosen_range(const Reading& now, const Settings& settings) {
    StepRange range = settings.play_range;
    if (now.pressed(Action::range_first))
        range = begun_at(settings.instant.step, range);
    if (now.pressed(Action::range_last))
        range = ended_at(settings.instant.step, range);
    if (now.pressed(WandButton::mark_range) || now.pressed(GamepadButton::down))
        range = marked_at(settings.instant.step, range);
    if (now.pressed(Action::range_all))
        range = {};
    return range;
}

/// The bookmarks with the instant in addition, or without it; says what has become of it.
std::vector<Bookmark> toggled(const std::vector<Bookmark>& bookmarks, const Instant& at,
                              std::vector<std::string>& notes) {
    std::vector<Bookmark> now = toggled_bookmark(bookmarks, at);
    notes.push_back(
        now.size() < bookmarks.size() ? fmt::format("the bookmark at {} is removed", name_of(at))
        : now.size() > bookmarks.size()
            ? fmt::format("{} is bookmarked: Ctrl + N goes to the next bookmark", name_of(at))
            : fmt::format("there are {} bookmarks, and there is no room for more", kMostBookmarks));
    return now;
}

/// A stick that is pushed at least so far counts as a key.
constexpr double kPushed = 0.5;

/// The gaps where time that plays between the steps holds; null where steps are not blended.
const StepGaps* blended(const ControlContext& context) {
    static const StepGaps kNone;
    if (!context.settings.blends())
        return nullptr;
    return context.series.gaps ? context.series.gaps : &kNone;
}

/// The stick for time, -1 to 1; while a story is told it goes through the story.
double time_stick(const Reading& now, const Settings& settings) {
    return told_key(settings) ? 0.0 : now.wand_rate(WandValuator::step);
}

/// How fast time is pushed on, -1 to 1.
double push_rate(const Reading& now, const Settings& settings) {
    const double stick = settings.blends() ? time_stick(now, settings) : 0.0;
    return std::clamp(now.wand_rate(WandValuator::time) + stick, -1.0, 1.0);
}

} // namespace

Instant TimeControls::moved(const Reading& now, const ControlContext& context, Seconds time,
                            std::uint32_t steps) {
    const Settings& settings = context.settings;
    PlaybackState by = settings.playback;
    if (now.key(Action::shift)) // finely, as it moves the isovalue
        by.every = 1;
    const Instant from = settings.shown_instant();
    Instant to = from;
    const double stick = settings.blends() ? 0.0 : time_stick(now, settings);
    const int forward = forward_.presses(
        now.key(Action::step_forward) || now.pad(GamepadButton::right_bumper) || stick > kPushed,
        time);
    const int back = back_.presses(now.key(Action::step_back) ||
                                       now.pad(GamepadButton::left_bumper) || stick < -kPushed,
                                   time);
    for (int i = back; i < forward; ++i)
        to = Instant(next_step(to.step, by, steps));
    for (int i = forward; i < back; ++i)
        to = Instant(previous_step(to, by, steps));
    if (now.pressed(Action::first_step))
        to = Instant(first_of(settings.play_range, steps));
    if (now.pressed(Action::last_step))
        to = Instant(last_of(settings.play_range, steps));
    const Instant before = to;
    const bool told = told_key(settings) != nullptr; // whose buttons these are then
    if (now.pressed(Action::next_time) ||
        (!told && (now.pressed(WandButton::next_time) || now.pressed(GamepadButton::right))))
        if (const auto next = next_bookmark(settings.bookmarks, before, settings.blends()))
            to = *next;
    if (now.pressed(Action::previous_time) ||
        (!told && (now.pressed(WandButton::previous_time) || now.pressed(GamepadButton::left))))
        if (const auto previous = previous_bookmark(settings.bookmarks, before, settings.blends()))
            to = *previous;
    return to;
}

/// Pushed by the wand, time runs on as it plays, at a rate of its own, and stops at the ends.
Instant TimeControls::pushed(const Reading& now, const ControlContext& context, const Instant& from,
                             Seconds elapsed) {
    constexpr double kSeriesSeconds = 4.0;
    const std::vector<double>& times = *context.series.times;
    const Settings& settings = context.settings;
    const double rate = push_rate(now, settings);
    PlaybackState state;
    state.playing = rate != 0;
    state.reverse = rate < 0;
    state.loop = false;
    state.speed = std::abs(rate) * kRoundSeconds / kSeriesSeconds;
    const auto steps = static_cast<std::uint32_t>(times.size());
    const Instant end(state.reverse ? first_of(settings.play_range, steps)
                                    : last_of(settings.play_range, steps));
    state.playing = state.playing && from != end; // it would start over
    const Playback::Result reached =
        pushed_.advance(times, from, state, elapsed, settings.play_range, blended(context));
    return state.playing ? reached.instant : from;
}

void TimeControls::update(const Reading& now, const ControlContext& context, Seconds time,
                          Seconds elapsed, Commands& commands, std::vector<std::string>& notes) {
    static const std::vector<double> kNone;
    const std::vector<double>& times = context.series.times ? *context.series.times : kNone;
    const auto steps = static_cast<std::uint32_t>(times.size());
    const Settings& settings = context.settings;
    PlaybackState state = chosen(now, settings.playback, times);
    const StepRange range = chosen_range(now, settings);
    const Instant from = settings.shown_instant();
    Instant to = from;
    if (steps > 0)
        to = moved(now, context, time, steps);
    if (steps > 0 && to == from)
        to = pushed(now, context, from, elapsed);
    if (to != from || push_rate(now, settings) != 0)
        state.playing = false;
    const Playback::Result reached =
        playback_.advance(times, to, state, elapsed, range, blended(context));
    state.playing = reached.playing;
    state.reverse = reached.reverse;
    if (reached.instant != from)
        commands.instant = reached.instant;
    if (state != settings.playback)
        commands.playback = state;
    if (range != settings.play_range)
        commands.play_range = range;
    if (now.pressed(Action::save_time) || now.pressed(WandButton::save_time) ||
        now.pressed(GamepadButton::up))
        commands.bookmarks = toggled(settings.bookmarks, settings.shown_instant(), notes);
}

} // namespace isochron::interaction
