// Events of mouse, keyboard and gamepad that a window reports, independent of the windowing
// library.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

namespace isochron::interaction {

/// Keys. The value of a letter or digit is its upper-case ASCII code; other keys have names.
enum class Key : std::uint16_t {
    unknown = 0,
    space = 32,
    minus = '-',
    equal = '=',
    comma = ',',
    period = '.',
    left_bracket = '[',
    right_bracket = ']',
    escape = 256,
    enter,
    tab,
    backspace,
    insert,
    del,
    right,
    left,
    down,
    up,
    page_up,
    page_down,
    home,
    end,
    f1 = 290,
    f2,
    f3,
    f4,
    f5,
    f6,
    f7,
    f8,
    f9,
    f10,
    f11,
    f12,
    left_shift = 340,
    left_control,
    left_alt,
    right_shift = 344,
    right_control,
    right_alt
};

/// Modifier keys as bits, as the window system states them with each key: it also knows of those
/// that went down before the window had the focus. AltGr is none of them: it chooses characters.
enum class Modifier : std::uint8_t { control = 1, alt = 2, super = 4 };

struct KeyEvent {
    Key key;
    bool down;
    std::uint8_t modifiers = 0; ///< bits of `Modifier` that are held

    bool with(Modifier modifier) const { return modifiers & static_cast<std::uint8_t>(modifier); }
    /// Whether this is the key itself, and not a combination with Ctrl, Alt or Super.
    bool alone() const { return modifiers == 0; }
};
struct TextEvent {
    char32_t character;
};
enum class MouseButton : std::uint8_t { left, right, middle };
struct MouseButtonEvent {
    MouseButton button;
    bool down;
};
/// Cursor position as a fraction of the window, (0,0) at the top left, and the window's size in
/// screen units, from which aspect and pixel distances follow.
struct MouseMoveEvent {
    float x, y;
    int width, height;
    std::size_t window = 0; ///< index among the installation's windows that are open here
};
struct ScrollEvent {
    float dx, dy;
};
struct FocusEvent {
    bool focused;
};
/// The whole state of the first gamepad, sent when it changes. `axes`: left x, left y, right x,
/// right y, left trigger, right trigger, in [-1, 1], +x right, +y down, triggers -1 at rest.
/// `buttons`: bits in the order of `GamepadButton` (GLFW's). `present` is false once it is
/// unplugged.
struct GamepadEvent {
    bool present;
    float axes[6];
    std::uint32_t buttons;
};

using WindowEvent = std::variant<KeyEvent, TextEvent, MouseButtonEvent, MouseMoveEvent, ScrollEvent,
                                 FocusEvent, GamepadEvent>;

/// Whether a key was pressed among these events, and not a combination with it.
inline bool is_pressed(Key key, std::span<const WindowEvent> events) {
    return std::ranges::any_of(events, [key](const WindowEvent& event) {
        const auto* change = std::get_if<KeyEvent>(&event);
        return change && change->key == key && change->down && change->alone();
    });
}

} // namespace isochron::interaction
