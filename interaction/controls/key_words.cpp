// What keys have done, in words.
#include "interaction/controls/key_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>

namespace isochron::interaction {
namespace {

std::string on_or_off(const char* what, bool on) {
    return fmt::format("{}: {}", what, on ? "on" : "off");
}

std::string speed(const Settings& now) {
    const PlaybackState& playback = now.playback;
    switch (playback.unit) {
    case SpeedUnit::steps: return fmt::format("speed: {:.3g} steps a second", playback.rate);
    case SpeedUnit::series: return fmt::format("speed: x {:.3g}", playback.speed);
    default: return fmt::format("speed: {}", name_of(playback.unit));
    }
}

std::string every(const Settings& now) {
    const std::uint32_t each = now.playback.every;
    return each == 1 ? "every step is played" : fmt::format("1 step in {} is played", each);
}

std::string range(const Settings& now) {
    const StepRange& played = now.play_range;
    if (played == StepRange{})
        return "plays all steps";
    const auto end = [](const std::optional<std::uint32_t>& step, const char* open) {
        return step ? fmt::format("{}", *step + 1) : std::string(open);
    };
    return fmt::format("plays steps {} to {}", end(played.first, "1"),
                       end(played.last, "the last"));
}

std::string quality(const Settings& now) {
    return fmt::format("quality: {}", name_of(now.quality));
}

std::string coloring(const Settings& now) {
    const Coloring& colors = now.coloring;
    return fmt::format("color by: {}", colors.by == ColorBy::value && !colors.array.empty()
                                           ? colors.array
                                           : std::string(name_of(colors.by)));
}

std::string eyes(const Settings& now) {
    return fmt::format("eyes {:.0f} mm apart", 1000 * now.eye_separation);
}

std::string viewpoint(const Settings& now) {
    const auto at =
        std::ranges::find(now.views, now.room_from_physical, &Viewpoint::room_from_physical);
    return at == now.views.end() ? "no viewpoint is saved: B saves this one"
                                 : "viewpoint " + at->name;
}

struct Spoken {
    Action action;
    std::string (*words)(const Settings&);
};

using enum Action;
constexpr Spoken kSpoken[] = {
    {next_stereo, [](const Settings& now) { return "stereo: " + now.stereo; }},
    {quality_auto, quality},
    {quality_fast, quality},
    {quality_best, quality},
    {quality_paper, quality},
    {next_surface,
     [](const Settings& now) {
         return fmt::format("surface {} of {}", now.picked + 1, now.isosurfaces.size());
     }},
    {next_array, [](const Settings& now) { return "array: " + now.array; }},
    {next_coloring, coloring},
    {next_color_array, coloring},
    {orthographic,
     [](const Settings& now) { return on_or_off("parallel projection", now.orthographic); }},
    {between_steps,
     [](const Settings& now) { return fmt::format("between steps: {}", name_of(now.between)); }},
    {follow, [](const Settings& now) { return on_or_off("following the last step", now.follow); }},
    {loop, [](const Settings& now) { return on_or_off("loop", now.playback.loop); }},
    {ping_pong,
     [](const Settings& now) { return on_or_off("back and forth", now.playback.ping_pong); }},
    {reverse,
     [](const Settings& now) {
         return std::string(now.playback.reverse ? "time runs back" : "time runs forward");
     }},
    {faster, speed},
    {slower, speed},
    {speed_unit, speed},
    {skip_more, every},
    {skip_fewer, every},
    {range_first, range},
    {range_last, range},
    {range_all, range},
    {eyes_apart, eyes},
    {eyes_together, eyes},
    {next_view, viewpoint},
};

} // namespace

std::vector<std::string> words_of_keys(const Reading& now, const ControlContext& context,
                                       const Commands& commands) {
    std::vector<std::string> words;
    for (const Spoken& each : kSpoken) {
        if (!now.pressed(each.action))
            continue;
        Settings after = context.settings;
        each_setting(
            [](const Field&, auto& value, const auto& changed) {
                if (changed)
                    value = *changed;
            },
            after, commands);
        words.push_back(each.words(after));
    }
    if (holds(now.before.keys, teleport) && !now.key(teleport))
        words.emplace_back(commands.room_from_physical
                               ? "teleported: Ctrl + Z goes back"
                               : "no floor there: T teleports to a place on the floor");
    return words;
}

} // namespace isochron::interaction
