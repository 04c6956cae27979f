// Turns device states into commands.
#include "interaction/controls/controls.h"

#include "interaction/controls/key_repeat.h"
#include "interaction/controls/room_panel.h"
#include "interaction/controls/time_controls.h"
#include "interaction/input/actions.h"
#include "interaction/navigation/navigation.h"
#include "interaction/navigation/navigator.h"
#include "interaction/tools/clip_tool.h"
#include "interaction/tools/tool_box.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace isochron::interaction {
namespace {

constexpr double kLongestFrame = 0.1;    ///< [s] for rates: a stall must not become a leap
constexpr double kLongestPlayback = 1.0; ///< [s] that time may play on in one slow frame
constexpr double kRangeSeconds = 4.0;    ///< isovalue: whole range at full deflection
constexpr double kCoarse = 0.01;         ///< isovalue per key press, of the range
constexpr double kFine = 0.001;    ///< isovalue per key press with Shift, or per notch of the wheel
constexpr float kEyeStep = 0.001f; ///< [m]

} // namespace

bool has_colors(const ControlContext& context) {
    return context.color_arrays.names && !context.color_arrays.names->empty();
}

/// Colors by an array: at first by the one that was chosen before, then by the one after it.
Coloring by_next_array(const ControlContext& context) {
    const std::vector<std::string>& names = *context.color_arrays.names;
    const bool goes_on = context.settings.coloring.by == ColorBy::value;
    Coloring changed = context.settings.coloring;
    changed.by = ColorBy::value;
    changed.array = names[(context.color_arrays.chosen + (goes_on ? 1 : 0)) % names.size()];
    changed.range.reset();
    return changed;
}

/// The next quantity to color by. The range belonged to the previous one, so it is dropped.
Coloring after(const Coloring& coloring, bool has_second_array) {
    const auto next =
        static_cast<ColorBy>((static_cast<std::size_t>(coloring.by) + 1) % kNames<ColorBy>.size());
    const bool skipped = next == ColorBy::value && !has_second_array;
    Coloring changed = coloring;
    changed.by = skipped ? ColorBy::first_crossing : next;
    changed.range.reset();
    return changed;
}

struct Controls::State {
    ButtonLevels before;
    std::optional<Seconds> last_time;
    KeyRepeat isovalue_up, isovalue_down, eyes_apart, eyes_together;
    Navigator navigator;
    TimeControls time_controls;
    ToolBox tools;
    Commands found;                 ///< by tools, not yet taken
    std::vector<std::string> notes; ///< notes of tools, not yet taken
    int stamps = 0;
    std::optional<Seconds> clicked; ///< the mouse's last click, if it was not the second one

    double isovalue(const Reading& now, const ControlContext& context, Seconds time,
                    double seconds) {
        const bool shift = now.key(Action::shift);
        const double range = context.series.high - context.series.low;
        // In recordings of older versions the same keys also move the wand's valuator.
        const bool moved = now.wand_rate(WandValuator::isovalue) != 0;
        const auto down = [&](Action key, Action page) {
            return now.key(key) || (now.key(page) && !moved);
        };
        const int keys =
            isovalue_up.presses(down(Action::isovalue_up, Action::isovalue_rise), time) -
            isovalue_down.presses(down(Action::isovalue_down, Action::isovalue_fall), time);
        const double wheel =
            now.key(Action::control) ? Reading::valuator(now.mouse, kMouseWheel) : 0.0;
        const double rate = now.wand_rate(WandValuator::isovalue) +
                            now.axis(GamepadAxis::right_trigger) -
                            now.axis(GamepadAxis::left_trigger);
        const double change =
            keys * (shift ? kFine : kCoarse) + wheel * kFine + rate * seconds / kRangeSeconds;
        if (change == 0 || !(range > 0) || !std::isfinite(range))
            return context.settings.isovalue();
        const double now_shown = context.settings.isovalue();
        const double from = std::isfinite(now_shown) ? now_shown : context.series.low + range / 2;
        return std::clamp(from + change * range, context.series.low, context.series.high);
    }

    /// Saves the volume's place in this frame under the next free name; drops the oldest view if
    /// there are `kMostViews`.
    void save_view(const ControlContext& context, Commands& commands) {
        commands.views =
            with_view(context.settings.views,
                      commands.room_from_physical.value_or(context.settings.room_from_physical));
        notes.push_back(
            fmt::format("viewpoint {} saved: N goes there", commands.views->back().name));
    }

    void switches(const Reading& now, const ControlContext& context, Seconds time,
                  Commands& commands) {
        const auto choose = [&](Action action, QualityMode mode) {
            if (now.pressed(action) && context.settings.quality != mode)
                commands.quality = mode;
        };
        choose(Action::quality_auto, QualityMode::automatic);
        choose(Action::quality_fast, QualityMode::fast);
        choose(Action::quality_best, QualityMode::quality);
        choose(Action::quality_paper, QualityMode::paper);

        const int eyes = eyes_apart.presses(now.key(Action::eyes_apart), time) -
                         eyes_together.presses(now.key(Action::eyes_together), time);
        const float separation =
            std::clamp(context.settings.eye_separation + static_cast<float>(eyes) * kEyeStep, 0.0f,
                       kWidestEyes);
        if (eyes != 0 && separation != context.settings.eye_separation)
            commands.eye_separation = separation;

        if (now.pressed(Action::next_stereo) && context.stereo_modes &&
            !context.stereo_modes->empty()) {
            const std::vector<std::string>& modes = *context.stereo_modes;
            const auto mode = std::ranges::find(modes, context.settings.stereo);
            const bool wraps = mode == modes.end() || mode + 1 == modes.end();
            commands.stereo = wraps ? modes.front() : *(mode + 1);
        }
        if (now.pressed(Action::orthographic))
            commands.orthographic = !context.settings.orthographic;
        if (now.pressed(Action::bounding_box))
            commands.bounding_box = !context.settings.bounding_box;
        if (now.pressed(Action::next_surface) && context.settings.isosurfaces.size() > 1)
            commands.picked = (context.settings.picked + 1) %
                              static_cast<std::uint32_t>(context.settings.isosurfaces.size());
        if (now.pressed(Action::next_coloring))
            commands.coloring = after(context.settings.coloring, has_colors(context));
        if (now.pressed(Action::next_color_array) && has_colors(context))
            commands.coloring = by_next_array(context);
        if (now.pressed(Action::next_array) && context.ways.next_array) {
            commands.isovalue.reset(); // it was of the array before
            merge(commands, *context.ways.next_array);
        }
        if (now.pressed(Action::panel))
            commands.panel = !context.settings.panel;
        if (now.pressed(Action::room_panel) || now.pressed(WandButton::room_panel) ||
            now.pressed(GamepadButton::back))
            commands.room_panel = called(context.settings.room_panel, now.viewer(),
                                         context.called_panel.distance, context.called_panel.place);
        // The panel at arm's length can only be read in perspective projection.
        if (commands.room_panel && commands.room_panel->shown && context.settings.orthographic)
            commands.orthographic = false;
        if (now.pressed(Action::grid))
            commands.grid = !context.settings.grid;
        if (now.pressed(Action::save_view))
            save_view(context, commands);
        if (now.pressed(Action::stamp))
            commands.stamps.push_back(fmt::format("stamp-{}", ++stamps));
        commands.screenshot = now.pressed(Action::screenshot);
        commands.copy = now.pressed(Action::copy);
        commands.save = now.pressed(Action::save_session);
        if (now.pressed(Action::export_surfaces))
            commands.exporting = ExportWork{.goes_on = !context.settings.exporting.goes_on};
    }

    /// Escape goes back to the first tools, or else asks whether to quit; Enter answers yes. An
    /// answer in the same frame as the question counts.
    static void leave(const Reading& now, const ControlContext& context, Commands& commands) {
        const bool asks = now.pressed(Action::quit) && context.settings.tools == Tools{};
        if (now.pressed(Action::pick) && context.settings.leaving != asks)
            commands.quit = true;
        if (now.pressed(Action::ask_to_quit) && !context.settings.leaving)
            commands.leaving = true;
        if (!now.pressed(Action::quit))
            return;
        if (context.settings.leaving || asks)
            commands.leaving = !context.settings.leaving;
        else
            commands.tools = Tools{};
    }

    /// Keys choose the tool of mouse and wand; the wand's button chooses for the wand alone.
    static void choose_tools(const Reading& now, const ControlContext& context,
                             Commands& commands) {
        Tools tools = context.settings.tools;
        if (now.pressed(Action::first_tools))
            tools = {};
        for (const auto& [action, kind] : {std::pair(Action::clip_tool, ToolKind::clip),
                                           std::pair(Action::ruler_tool, ToolKind::ruler)})
            if (now.pressed(action))
                tools.mouse = tools.wand = kind;
        if (now.pressed(WandButton::next_tool))
            tools.wand = static_cast<ToolKind>((static_cast<std::size_t>(tools.wand) + 1) %
                                               kNames<ToolKind>.size());
        if (tools != context.settings.tools)
            commands.tools = tools;
        if (now.pressed(Action::snap_clip))
            commands.clip = snapped_next(context.settings.clip, context.data);
        if (now.pressed(Action::flip_clip) && context.settings.clip.shown)
            commands.clip = flipped(context.settings.clip);
        if (now.pressed(Action::remove_made))
            remove_made(context, commands);
    }

    static void remove_made(const ControlContext& context, Commands& commands) {
        switch (context.settings.tools.mouse) {
        case ToolKind::clip: commands.clip = ClipPlane{}; break;
        case ToolKind::ruler: commands.ruler = Ruler{}; break;
        default: commands.mark = Mark{};
        }
    }

    /// Undo and redo override all other commands of the frame.
    static void take_back(const Reading& now, const ControlContext& context, Commands& commands) {
        const auto obey = [&](Action action, WandButton button, const Commands* change) {
            if (change && (now.pressed(action) || now.pressed(button)))
                merge(commands, *change);
        };
        obey(Action::undo, WandButton::undo, context.ways.undo);
        obey(Action::redo, WandButton::redo, context.ways.redo);
    }

    /// Two clicks in quick succession bring a place on a surface to the middle of the view, at the
    /// same distance. It depends on the surfaces that are shown.
    void focus(const Reading& now, const ControlContext& context, Seconds time,
               const Similarity& volume) {
        if (!(Reading::buttons(now.mouse) & ~now.before.mouse & bit(MouseBit::left)))
            return;
        const bool twice = clicked && time - *clicked <= kDoubleClick;
        clicked = twice ? std::nullopt : std::optional(time);
        const auto eye = Reading::hand(now.pointer);
        if (!twice || !eye || !context.find_surface ||
            context.settings.tools.mouse != ToolKind::pick)
            return;
        const auto hit = context.find_surface(*eye);
        if (!hit)
            return;
        const Pose head = now.viewer();
        const glm::dvec3 from(head.position), at = transform(volume, hit->point.position);
        const glm::dvec3 ahead =
            glm::normalize(glm::dquat(head.orientation)) * glm::dvec3(0, 0, -1);
        found.room_from_physical = moved(volume, from + glm::distance(at, from) * ahead - at);
    }

    /// Says why the wheel does nothing any more.
    void tell_bounds(const Reading& now, const ControlContext& context, const Similarity& volume) {
        if (!now.key(Action::control) && Reading::valuator(now.mouse, kMouseWheel) != 0 &&
            volume == context.settings.room_from_physical)
            notes.emplace_back(
                "the data can be made no larger or smaller; Home resets the view and all settings");
    }

    ToolBox::Outcome with_tools(const Reading& now, const ControlContext& context,
                                const Similarity& volume) {
        return context.settings.leaving ? ToolBox::Outcome() : tools.update(now, {context, volume});
    }
};

Controls::Controls() : state_(std::make_unique<State>()) {}
Controls::~Controls() = default;

Commands Controls::update(const InputState& input, const ControlContext& context) {
    State& s = *state_;
    const Reading now(input, s.before);
    s.before = now.levels();
    const double elapsed = s.last_time ? std::max((input.time - *s.last_time).count(), 0.0) : 0.0;
    const double seconds = std::min(elapsed, kLongestFrame);
    s.last_time = input.time;

    Commands commands;
    const Similarity volume =
        s.navigator.update(now, context, seconds, s.tools.takes_drag(now, context));
    if (volume != context.settings.room_from_physical)
        commands.room_from_physical = volume;
    s.tell_bounds(now, context, volume);
    s.focus(now, context, input.time, volume);
    const double isovalue = s.isovalue(now, context, input.time, seconds);
    if (isovalue != context.settings.isovalue() && std::isfinite(isovalue))
        commands.isovalue = isovalue;
    s.time_controls.update(now, context, input.time, Seconds(std::min(elapsed, kLongestPlayback)),
                           commands, s.notes);
    s.switches(now, context, input.time, commands);
    s.leave(now, context, commands);
    s.choose_tools(now, context, commands);
    const ToolBox::Outcome made = s.with_tools(now, context, volume);
    merge(commands, made.commands);
    merge(s.found, made.found);
    s.notes.insert(s.notes.end(), made.notes.begin(), made.notes.end());
    if (now.pressed(Action::reset) && context.ways.start)
        merge(commands, *context.ways.start);
    s.take_back(now, context, commands);
    return commands;
}

Commands Controls::take_found() {
    return std::exchange(state_->found, {});
}

std::vector<std::string> Controls::take_notes() {
    return std::exchange(state_->notes, {});
}

std::vector<ControlGroup> Controls::documentation() {
    const auto line_of = [](std::string_view control, std::string_view effect) {
        return fmt::format("{:<30}{}", control, effect);
    };
    std::vector<ControlGroup> groups;
    for (const DeviceKind kind :
         {DeviceKind::mouse, DeviceKind::keyboard, DeviceKind::hands, DeviceKind::gamepad}) {
        ControlGroup& group = groups.emplace_back(kind, std::vector<std::string>());
        for (const ControlLine& line : control_lines())
            if (line.device == kind)
                group.lines.push_back(line_of(line.control, line.effect));
        if (kind == DeviceKind::keyboard)
            for (const KeyLine& line : key_lines())
                group.lines.push_back(line_of(line.keys, line.effect));
    }
    return groups;
}

} // namespace isochron::interaction
