// Turns device states into commands.
#include "interaction/controls/controls.h"

#include "interaction/controls/action_table.h"
#include "interaction/controls/key_frame_controls.h"
#include "interaction/controls/key_repeat.h"
#include "interaction/controls/key_words.h"
#include "interaction/controls/room_panel.h"
#include "interaction/controls/story_controls.h"
#include "interaction/controls/time_controls.h"
#include "interaction/navigation/navigation.h"
#include "interaction/navigation/navigator.h"
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

struct Controls::State {
    ButtonLevels before;
    std::optional<Seconds> last_time;
    KeyRepeat isovalue_up, isovalue_down, eyes_apart, eyes_together;
    Navigator navigator;
    TimeControls time_controls;
    StoryControls story;
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

    /// What a press of a key does by its row, and what else does the same.
    void press(const Reading& now, const ControlContext& context, Commands& commands) {
        for (const KeyLine& line : key_lines())
            for (const ActionRow& row : line.actions)
                if (row.effect && now.pressed(row.action))
                    row.effect({context, commands, notes});
        if (now.pressed(Action::room_panel) || now.pressed(WandButton::room_panel) ||
            now.pressed(GamepadButton::back))
            commands.room_panel = called(context.settings.room_panel, now.viewer(),
                                         context.called_panel.distance, context.called_panel.place);
        // The panel at arm's length can only be read in perspective projection.
        if (commands.room_panel && commands.room_panel->shown && context.settings.orthographic)
            commands.orthographic = false;
        for (const Action action : kKeyFrameActions)
            if (now.pressed(action))
                press_key_frames(action, context.settings, now.viewer(), commands, notes);
        if (now.pressed(Action::stamp))
            commands.stamps.push_back(fmt::format("stamp-{}", ++stamps));
        if (now.pressed(WandButton::next_tool)) {
            Tools held = commands.tools.value_or(context.settings.tools);
            held.wand = static_cast<ToolKind>((static_cast<std::size_t>(held.wand) + 1) %
                                              kNames<ToolKind>.size());
            commands.tools = held;
        }
    }

    void move_eyes(const Reading& now, const ControlContext& context, Seconds time,
                   Commands& commands) {
        const int eyes = eyes_apart.presses(now.key(Action::eyes_apart), time) -
                         eyes_together.presses(now.key(Action::eyes_together), time);
        const float separation =
            std::clamp(context.settings.eye_separation + static_cast<float>(eyes) * kEyeStep, 0.0f,
                       kWidestEyes);
        if (eyes != 0 && separation != context.settings.eye_separation)
            commands.eye_separation = separation;
    }

    /// Ctrl + Q asks whether to quit; Enter answers yes, Escape answers no. Else Escape goes back to
    /// the first tools. An answer in the same frame as the question counts.
    static void leave(const Reading& now, const ControlContext& context, Commands& commands) {
        const bool asked = context.settings.leaving, asks = now.pressed(Action::ask_to_quit);
        const bool escapes = now.pressed(Action::quit);
        if (now.pressed(Action::pick) && (asked || asks) && !escapes)
            commands.quit = true;
        if (asks && !asked && !escapes)
            commands.leaving = true;
        if (escapes && asked)
            commands.leaving = false;
        else if (escapes && context.settings.tools != Tools{})
            commands.tools = Tools{};
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

namespace {

/// What is left of the devices while the program asks whether to quit: the keys that answer.
InputState only_answers(InputState input) {
    const ActionSet answers = bit(Action::quit) | bit(Action::pick) | bit(Action::ask_to_quit);
    for (DeviceState& device : input.devices) {
        device.actions &= answers;
        if (device.name == "mouse" || device.name == "keys") {
            device.buttons = 0;
            device.valuators.clear();
        }
    }
    return input;
}

} // namespace

Controls::Controls() : state_(std::make_unique<State>()) {}
Controls::~Controls() = default;

Commands Controls::update(const InputState& devices, const ControlContext& context) {
    State& s = *state_;
    const InputState input = context.settings.leaving ? only_answers(devices) : devices;
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
    s.move_eyes(now, context, input.time, commands);
    s.leave(now, context, commands);
    s.press(now, context, commands);
    s.story.update(now, context, input.time, commands, s.notes);
    const ToolBox::Outcome made = s.with_tools(now, context, volume);
    merge(commands, made.commands);
    merge(s.found, made.found);
    s.notes.insert(s.notes.end(), made.notes.begin(), made.notes.end());
    for (std::string& words : words_of_keys(now, context, commands))
        s.notes.push_back(std::move(words));
    if (now.pressed(Action::reset) && context.ways.start)
        merge(commands, *context.ways.start);
    s.take_back(now, context, commands);
    return commands;
}

bool Controls::tells_on(std::uint32_t told) const {
    return state_->story.goes_on(told);
}

Commands Controls::take_found() {
    return std::exchange(state_->found, {});
}

std::vector<std::string> Controls::take_notes() {
    return std::exchange(state_->notes, {});
}

std::vector<ControlGroup> Controls::documentation() {
    const auto line_of = [](std::string_view control, std::string_view effect) {
        return fmt::format("{:<28}  {}", control, effect);
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
