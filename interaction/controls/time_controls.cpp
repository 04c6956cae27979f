// The controls of time: playing, steps, the range that is played, bookmarks.
#include "interaction/controls/time_controls.h"

#include "interaction/step_track.h"

#include <algorithm>

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
        range = begun_at(settings.step, range);
    if (now.pressed(Action::range_last))
        range = ended_at(settings.step, range);
    if (now.pressed(WandButton::mark_range) || now.pressed(GamepadButton::down))
        range = marked_at(settings.step, range);
    if (now.pressed(Action::range_all))
        range = {};
    return range;
}

/// The bookmarks with the step in addition, or without it if it is among them.
std::vector<Bookmark> toggled(std::vector<Bookmark> bookmarks, std::uint32_t step,
                              std::vector<std::string>& notes) {
    if (std::erase_if(bookmarks, [&](const Bookmark& each) { return each.step == step; }) > 0) {
        notes.push_back(fmt::format("step {} is no bookmark any more", step + 1));
    } else if (bookmarks.size() == kMostBookmarks) {
        notes.push_back(fmt::format("no more than {} times can be bookmarked", kMostBookmarks));
    } else {
        const auto after =
            std::ranges::find_if(bookmarks, [&](const Bookmark& each) { return each.step > step; });
        bookmarks.insert(after, {fmt::format("step {}", step + 1), step});
        notes.push_back(
            fmt::format("step {} is bookmarked: Ctrl + N goes to the next bookmark", step + 1));
    }
    return bookmarks;
}

} // namespace

std::uint32_t TimeControls::moved(const Reading& now, const ControlContext& context, Seconds time,
                                  std::uint32_t steps) {
    const Settings& settings = context.settings;
    PlaybackState by = settings.playback;
    if (now.key(Action::shift)) // finely, as it moves the isovalue
        by.every = 1;
    std::uint32_t step = settings.step;
    const int forward = forward_.presses(
        now.key(Action::step_forward) || now.pad(GamepadButton::right_bumper), time);
    const int back =
        back_.presses(now.key(Action::step_back) || now.pad(GamepadButton::left_bumper), time);
    for (int i = back; i < forward; ++i)
        step = next_step(step, by, steps);
    for (int i = forward; i < back; ++i)
        step = previous_step(step, by, steps);
    if (now.pressed(Action::first_step))
        step = first_of(settings.play_range, steps);
    if (now.pressed(Action::last_step))
        step = last_of(settings.play_range, steps);
    if (now.pressed(Action::next_time) || now.pressed(WandButton::next_time) ||
        now.pressed(GamepadButton::right))
        step = next_bookmark(settings.bookmarks, step).value_or(step);
    if (now.pressed(Action::previous_time) || now.pressed(WandButton::previous_time) ||
        now.pressed(GamepadButton::left))
        step = previous_bookmark(settings.bookmarks, step).value_or(step);
    return step;
}

void TimeControls::update(const Reading& now, const ControlContext& context, Seconds time,
                          Seconds elapsed, Commands& commands, std::vector<std::string>& notes) {
    static const std::vector<double> kNone;
    const std::vector<double>& times = context.series.times ? *context.series.times : kNone;
    const auto steps = static_cast<std::uint32_t>(times.size());
    const Settings& settings = context.settings;
    PlaybackState state = chosen(now, settings.playback, times);
    const StepRange range = chosen_range(now, settings);
    std::uint32_t step = settings.step;
    if (steps > 0)
        step = moved(now, context, time, steps);
    if (step != settings.step)
        state.playing = false;
    const Playback::Result reached = playback_.advance(times, step, state, elapsed, range);
    state.playing = reached.playing;
    state.reverse = reached.reverse;
    if (reached.step != settings.step)
        commands.step = reached.step;
    if (now.pressed(Action::follow)) {
        commands.follow = !settings.follow;
        if (*commands.follow && steps > 0)
            commands.step = steps - 1;
    }
    if (state != settings.playback)
        commands.playback = state;
    if (range != settings.play_range)
        commands.play_range = range;
    if (now.pressed(Action::save_time) || now.pressed(WandButton::save_time) ||
        now.pressed(GamepadButton::up))
        commands.bookmarks = toggled(settings.bookmarks, settings.step, notes);
}

} // namespace isochron::interaction
