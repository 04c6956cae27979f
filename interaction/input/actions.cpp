// The words that explain the controls of mouse, hands and gamepad.
#include "interaction/input/actions.h"

#include <array>
#include <utility>

#include <fmt/format.h>

namespace isochron::interaction {
namespace {

std::string name_of_key(Key key) {
    constexpr std::pair<Key, const char*> kNames[]{
        {Key::space, "Space"}, {Key::escape, "Escape"},   {Key::enter, "Enter"},
        {Key::tab, "Tab"},     {Key::insert, "Insert"},   {Key::del, "Delete"},
        {Key::right, "Right"}, {Key::left, "Left"},       {Key::down, "Down"},
        {Key::up, "Up"},       {Key::page_up, "Page Up"}, {Key::page_down, "Page Down"},
        {Key::home, "Home"},   {Key::end, "End"},         {Key::equal, "+"}};
    for (const auto& [each, name] : kNames)
        if (each == key)
            return name;
    const auto code = static_cast<int>(key);
    if (key >= Key::f1 && key <= Key::f12)
        return fmt::format("F{}", code - static_cast<int>(Key::f1) + 1);
    return std::string(1, static_cast<char>(code));
}

} // namespace

std::string name_of(const KeyStroke& stroke) {
    const char* with = stroke.chord == Chord::control_shift ? "Ctrl + Shift + "
                       : stroke.chord == Chord::control     ? "Ctrl + "
                                                            : "";
    return with + name_of_key(stroke.key);
}

std::span<const ControlLine> control_lines() {
    using enum DeviceKind;
    static constexpr std::array<ControlLine, 41> kLines{{
        {mouse, "Click", "pick the surface there, or what the chosen tool does"},
        {mouse, "Double click", "bring that place of a surface to the middle of the view"},
        {mouse, "Left drag", "orbit: turn the volume about its center"},
        {mouse, "Middle drag, or Shift + left", "move the volume"},
        {mouse, "Right drag", "look around"},
        {mouse, "Right click", "menu: copy value, mark, clip, isovalue here, show all"},
        {mouse, "Wheel", "scale about the place under the cursor"},
        {mouse, "Ctrl + wheel", "isovalue by 0.1 % of the range"},
        {mouse, "Mouse", "aims the wand"},
        {keyboard, "F1 or ?", "help: keys, mouse and devices"},
        {keyboard, "Ctrl + K", "find any control by its words, and set it: opacity 40"},
        {keyboard, "F11", "full screen on, off"},
        {keyboard, "Ctrl + O", "open other data"},
        {keyboard, "Ctrl + Shift + A", "all arrays: names, values, units and grids"},
        {hands, "Wand button 1 (hold)", "grab: the volume follows the wand"},
        {hands, "Wand button 2 (hold)", "fly where the wand points"},
        {hands, "Wand valuator 1", "isovalue, the whole range in 4 s"},
        {hands, "Wand valuator 2", "scale, twice the size in 1 s"},
        {hands, "Wand button 3 (hold)", "aim at the floor; letting go teleports there"},
        {hands, "Wand buttons 4, 5", "recenter, next saved viewpoint"},
        {hands, "Wand buttons 6, 7, 8", "room panel, pick the surface, read the data at the tip"},
        {hands, "Wand buttons 9, 10, 11", "next tool for button 1, undo, redo"},
        {hands, "Wand buttons 12, 13, 14", "bookmark this time, next, previous bookmark"},
        {hands, "Wand buttons 13, 14, stick", "while a story is told: its next, previous step"},
        {hands, "Wand button 15", "the range that plays begins here, ends here, is all steps"},
        {hands, "Wand on the room's panel",
         "button 1 clicks, drags; title moves it, stick scrolls"},
        {hands, "Wand valuator 3", "fly where the wand points, or back"},
        {hands, "Wand valuator 4", "turn by 30 degrees"},
        {hands, "Wand valuator 5", "time forward, back: the whole series in 4 s"},
        {hands, "Both wands' button 1", "move, turn and scale the volume between two hands"},
        {gamepad, "back", "panel in the room"},
        {gamepad, "thumb buttons", "recenter (left), next saved viewpoint (right)"},
        {gamepad, "left stick", "fly forward, back and sideways"},
        {gamepad, "right stick", "turn, rise and sink"},
        {gamepad, "triggers", "lower, raise the isovalue"},
        {gamepad, "bumpers", "one step back, forward"},
        {gamepad, "A, B", "play or pause, reverse"},
        {gamepad, "pad up, right, left", "bookmark this time, next, previous bookmark"},
        {gamepad, "pad right, left", "while a story is told: its next, previous step"},
        {gamepad, "pad down", "the range that plays begins here, ends here, is all steps"},
        {gamepad, "X, Y", "reset the volume, hold to grab it with the wand"},
    }};
    return kLines;
}

std::string_view words_of(DeviceKind device) {
    switch (device) {
    case DeviceKind::mouse: return "Mouse";
    case DeviceKind::keyboard: return "Keyboard";
    case DeviceKind::hands: return "Tracked hands (wands) and a headset's controllers";
    case DeviceKind::gamepad: return "Gamepad";
    }
    return "";
}

} // namespace isochron::interaction
