// What keys, mouse, wand and gamepad do: the meaning of each button bit and valuator.
#pragma once

#include "interaction/input/window_event.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::interaction {

/// Bits of the devices `keys` and, from `kFirstOfMoreKeys` on, `more_keys`: the action, whichever key
/// is bound to it.
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
    // Add new ones at the end: recordings store the bits.
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
    first_tools,
    clip_tool,
    ruler_tool,
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
    count
};
/// Recordings keep 64 bits of a device. Those of older versions have no `more_keys`.
inline constexpr int kFirstOfMoreKeys = 64;
static_assert(static_cast<int>(Action::count) <= 2 * kFirstOfMoreKeys);

constexpr bool is_of_more_keys(Action action) {
    return static_cast<int>(action) >= kFirstOfMoreKeys;
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
/// In the buttons of `keys`, or of `more_keys` if the action is one of those.
template <>
constexpr std::uint64_t bit(Action action) {
    return std::uint64_t{1} << static_cast<unsigned>(action) % kFirstOfMoreKeys;
}

/// The modifiers with which a key is bound: none (Shift may be held all the same), Ctrl, or Ctrl
/// and Shift. A key with Alt, Super, or a Ctrl that it is not bound with, does nothing.
enum class Chord : std::uint8_t { none, control, control_shift };

struct KeyBinding {
    Key key;
    Action action;
    Chord chord = Chord::none;
};

/// One line of documentation together with the bindings that it documents.
struct KeyLine {
    std::string_view keys;   ///< as printed on the keyboard
    std::string_view effect; ///< what they do
    std::vector<KeyBinding> bindings;
};
/// All keys with actions; `control_lines` has the keys that the window itself handles. The line
/// for Shift and Ctrl themselves comes last, since other lines say what they do with other keys.
std::span<const KeyLine> key_lines();

/// The devices that controls are grouped by in the help.
enum class DeviceKind : std::uint8_t { mouse, keyboard, hands, gamepad };
/// For people: `Keyboard`, `Tracked hands (wands) and a headset's controllers`, ...
std::string_view words_of(DeviceKind device);

/// A control of mouse, wand or gamepad, or a key that the window itself handles.
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

/// Actions that do not change the picture of the data: the motion gate ignores them.
constexpr std::uint64_t quiet_actions() {
    return bit(Action::shift) | bit(Action::control) | bit(Action::quality_auto) |
           bit(Action::quality_fast) | bit(Action::quality_best) | bit(Action::quality_paper) |
           bit(Action::screenshot) | bit(Action::stamp) | bit(Action::panel) | bit(Action::quit) |
           bit(Action::save_view) | bit(Action::bounding_box) | bit(Action::next_surface) |
           bit(Action::room_panel) | bit(Action::pick) | bit(Action::probe) | bit(Action::undo) |
           bit(Action::redo) | bit(Action::first_tools) | bit(Action::clip_tool) |
           bit(Action::ruler_tool) | bit(Action::snap_clip) | bit(Action::remove_made) |
           bit(Action::ping_pong);
}
/// The quiet actions among `more_keys`: all but those that show another step.
constexpr std::uint64_t quiet_among_more_keys() {
    return ~(bit(Action::first_step) | bit(Action::last_step) | bit(Action::next_time) |
             bit(Action::previous_time));
}

} // namespace isochron::interaction
