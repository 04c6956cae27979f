// What keys, mouse, wand and gamepad do: the actions, and the meaning of each button and valuator.
#pragma once

#include "interaction/input/window_event.h"
#include "interaction/setting_values.h"

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::interaction {

/// What a key does, whichever key it is. Each action has a row in
/// interaction/controls/action_table.cpp, which tells its name, keys, words and effect.
enum class Action : std::uint8_t {
    walk_forward,
    walk_back,
    walk_left,
    walk_right,
    walk_up,
    walk_down,
    shift,   ///< modifier: faster walking and flying, finer isovalue, left drag moves
    control, ///< modifier: the wheel changes the isovalue
    grab,
    fly,
    grow,
    shrink,
    isovalue_up,
    isovalue_down,
    isovalue_rise, ///< continuous
    isovalue_fall, ///< continuous
    step_forward,
    step_back,
    play,
    reverse,
    loop,
    faster,
    slower,
    reset,
    quality_auto,
    quality_fast,
    quality_best,
    eyes_apart,
    eyes_together,
    next_stereo,
    screenshot,
    stamp,
    panel,
    quit,
    turn_left,
    turn_right,
    teleport,
    recenter,
    save_view,
    next_view,
    grid,
    bounding_box,
    next_surface,
    next_coloring,
    room_panel,
    pick,
    probe,
    undo,
    redo,
    snap_clip,
    remove_made,
    follow,
    orthographic,
    axis_view,
    isometric_view,
    quality_paper,
    exaggerate,
    flatten,
    next_array,
    next_color_array,
    ping_pong,
    range_first,
    range_last,
    range_all,
    first_step,
    last_step,
    skip_more,
    skip_fewer,
    speed_unit,
    save_time,
    next_time,
    previous_time,
    copy,
    save_session,
    ask_to_quit,
    flip_clip,
    between_steps,
    export_surfaces,
    lift_background,
    add_key,
    next_key,
    previous_key,
    remove_key,
    snap_slice,
    add_slice,
    slice_forward,
    slice_back,
    slices_alone,
    curves,
    ghosts,
    next_told,
    previous_told,
    leave_story,
    ruler_angle,
    profile,
    annotations,
    count
};
/// Each tool can be chosen, too: those actions follow the others.
constexpr Action choice_of(ToolKind tool) {
    return static_cast<Action>(static_cast<std::size_t>(Action::count) +
                               static_cast<std::size_t>(tool));
}
inline constexpr std::size_t kActions =
    static_cast<std::size_t>(Action::count) + kNames<ToolKind>.size();

inline constexpr int kNoOldBit = -1; ///< for an action that recordings of version 1 do not know

/// The actions of the keys that are down.
using ActionSet = std::bitset<kActions>;
inline ActionSet bit(Action action) {
    return ActionSet().set(static_cast<std::size_t>(action));
}
inline bool holds(const ActionSet& set, Action action) {
    return set[static_cast<std::size_t>(action)];
}

inline constexpr float kHurry = 3.0f; ///< times as fast while Shift is held

/// Bits of the device `mouse` and, in the same order, the pairs of its valuators: horizontal and
/// vertical drag with that button since the last poll, in window heights, right and down positive.
/// The valuator after the pairs is the wheel in notches, away from the user positive.
enum class MouseBit : std::uint8_t { left, right, middle };
inline constexpr std::size_t kMouseWheel = 6;
inline constexpr std::size_t kMouseValuators = 7;

/// Bits of the device `wand`, and of `wand2` (the other hand). Of `wand2` only `grab` is read.
enum class WandButton : std::uint8_t {
    grab,
    fly,
    teleport,
    recenter,
    next_view,
    room_panel,
    pick,
    probe,
    next_tool,
    undo,
    redo,
    save_time,
    next_time,
    previous_time,
    mark_range
};
/// Valuators of the device `wand`, each in [-1, 1] and 0 at rest: rate of the isovalue, rate of the
/// scale, speed of flying in the direction of the wand, snap turns (right positive), rate of time, and
/// a headset's stick for time: where steps are blended its rate, else a push is a step.
enum class WandValuator : std::uint8_t { isovalue, scale, fly, turn, time, step, count };

/// Bits of the device `gamepad`, in the order in which windowing libraries report them.
enum class GamepadButton : std::uint8_t {
    a,
    b,
    x,
    y,
    left_bumper,
    right_bumper,
    back,
    start,
    guide,
    left_thumb,
    right_thumb,
    up,
    right,
    down,
    left
};
/// Valuators of the device `gamepad`, 0 inside the dead zone: sticks in [-1, 1], +x right, +y down;
/// triggers in [0, 1].
enum class GamepadAxis : std::uint8_t {
    left_x,
    left_y,
    right_x,
    right_y,
    left_trigger,
    right_trigger,
    count
};

template <typename Button>
constexpr std::uint64_t bit(Button button) {
    return std::uint64_t{1} << static_cast<unsigned>(button);
}

/// The modifiers with which a key is bound: none (Shift may be held all the same), Ctrl, or Ctrl
/// and Shift. A key with Alt, Super, or a Ctrl that it is not bound with, does nothing.
enum class Chord : std::uint8_t { none, control, control_shift };

struct KeyStroke {
    Key key;
    Chord chord = Chord::none;
    constexpr KeyStroke(Key pressed, Chord with = Chord::none) : key(pressed), chord(with) {}
    /// @param upper_case a letter, a digit, or what else is printed on the key
    constexpr KeyStroke(char upper_case, Chord with = Chord::none)
        : key(static_cast<Key>(upper_case)), chord(with) {}
    bool operator==(const KeyStroke&) const = default;
};
/// For people: `Space`, `Ctrl + Shift + Z`.
std::string name_of(const KeyStroke& stroke);

/// The devices that controls are grouped by in the help.
enum class DeviceKind : std::uint8_t { mouse, keyboard, hands, gamepad };
/// For people: `Keyboard`, `Tracked hands (wands) and a headset's controllers`, ...
std::string_view words_of(DeviceKind device);

/// A control of mouse, wand or gamepad, or a key that the window itself handles; the other keys are
/// in interaction/controls/action_table.h.
struct ControlLine {
    DeviceKind device;
    std::string_view control, effect;
};
std::span<const ControlLine> control_lines();

/// The controls of one kind of device, one line each: name, spaces, effect.
struct ControlGroup {
    DeviceKind device;
    std::vector<std::string> lines;
};

} // namespace isochron::interaction
