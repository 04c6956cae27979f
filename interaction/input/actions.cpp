// The table of keys, and the words that explain every control.
#include "interaction/input/actions.h"

#include <array>

namespace isochron::interaction {
namespace {

constexpr Key letter(char upper_case) {
    return static_cast<Key>(upper_case);
}

} // namespace

std::span<const KeyLine> key_lines() {
    using enum Action;
    static const std::vector<KeyLine> lines{
        {"W A S D",
         "walk forward, left, back, right",
         {{letter('W'), walk_forward},
          {letter('A'), walk_left},
          {letter('S'), walk_back},
          {letter('D'), walk_right}}},
        {"E Q", "rise, sink", {{letter('E'), walk_up}, {letter('Q'), walk_down}}},
        {"G (hold)", "grab: the volume follows the wand", {{letter('G'), grab}}},
        {"F (hold)", "fly where the wand points", {{letter('F'), fly}}},
        {"X Z (hold)", "enlarge, shrink the volume", {{letter('X'), grow}, {letter('Z'), shrink}}},
        {"Up Down",
         "isovalue by 1 % of the range (Shift: 0.1 %)",
         {{Key::up, isovalue_up}, {Key::down, isovalue_down}}},
        {"Page Up, Page Down",
         "the same",
         {{Key::page_up, isovalue_rise}, {Key::page_down, isovalue_fall}}},
        {"Right Left, or . ,",
         "one step forward, back (pauses)",
         {{Key::right, step_forward},
          {Key::period, step_forward},
          {Key::left, step_back},
          {Key::comma, step_back}}},
        {"Ctrl + Left, Ctrl + Right",
         "first, last step of the range (or of all steps)",
         {{Key::left, first_step, Chord::control}, {Key::right, last_step, Chord::control}}},
        {"Space", "play, pause", {{Key::space, play}}},
        {"R", "reverse the direction of time", {{letter('R'), reverse}}},
        {"L, Ctrl + L",
         "loop, play back and forth: on, off",
         {{letter('L'), loop}, {letter('L'), ping_pong, Chord::control}}},
        {"Ctrl + , and Ctrl + .",
         "the range that plays begins, ends here (again: no more)",
         {{Key::comma, range_first, Chord::control}, {Key::period, range_last, Chord::control}}},
        {"Ctrl + Shift + .",
         "all steps play again",
         {{Key::period, range_all, Chord::control_shift}}},
        {"Ctrl + +, Ctrl + -",
         "show only every 2nd, 3rd .. step; more of them again",
         {{Key::equal, skip_more, Chord::control}, {Key::minus, skip_fewer, Chord::control}}},
        {"Ctrl + B",
         "bookmark this time (again: no more)",
         {{letter('B'), save_time, Chord::control}}},
        {"Ctrl + N, Ctrl + Shift + N",
         "next, previous bookmark",
         {{letter('N'), next_time, Chord::control},
          {letter('N'), previous_time, Chord::control_shift}}},
        {"End", "follow the last step as new ones come: on, off", {{Key::end, follow}}},
        {"+ -", "play twice, half as fast", {{Key::equal, faster}, {Key::minus, slower}}},
        {"Ctrl + R",
         "speed: of the whole series, steps a second, the data's time",
         {{letter('R'), speed_unit, Chord::control}}},
        {"Ctrl + T",
         "between two steps: blend them, hold the step before",
         {{letter('T'), between_steps, Chord::control}}},
        {"Home", "reset everything (Ctrl + Z undoes it)", {{Key::home, reset}}},
        {"8 9",
         "look along the next axis, from a corner",
         {{letter('8'), axis_view}, {letter('9'), isometric_view}}},
        {"Ctrl + E, Ctrl + Shift + E",
         "heights (z) more, less exaggerated, by a quarter",
         {{letter('E'), exaggerate, Chord::control}, {letter('E'), flatten, Chord::control_shift}}},
        {"0", "parallel (orthographic) projection on, off", {{letter('0'), orthographic}}},
        {"J K",
         "turn to the left, to the right by 30 degrees",
         {{letter('J'), turn_left}, {letter('K'), turn_right}}},
        {"T (hold)",
         "aim at the floor with the wand; letting go teleports there",
         {{letter('T'), teleport}}},
        {"C", "recenter: the volume stands ahead of you again", {{letter('C'), recenter}}},
        {"B N",
         "save this viewpoint, go to the next saved one",
         {{letter('B'), save_view}, {letter('N'), next_view}}},
        {"H", "floor grid on, off", {{letter('H'), grid}}},
        {"1 2 3, Ctrl + 1",
         "quality: automatic, fast, best, as in the paper",
         {{letter('1'), quality_auto},
          {letter('2'), quality_fast},
          {letter('3'), quality_best},
          {letter('1'), quality_paper, Chord::control}}},
        {"] [",
         "eyes 1 mm further apart, closer together",
         {{Key::right_bracket, eyes_apart}, {Key::left_bracket, eyes_together}}},
        {"O", "box with ticks and numbers on, off", {{letter('O'), bounding_box}}},
        {"I", "next isosurface: the one that the isovalue moves", {{letter('I'), next_surface}}},
        {"U", "color by surface, array, time of first crossing", {{letter('U'), next_coloring}}},
        {"Ctrl + A, Ctrl + U",
         "next array of the surfaces, next array to color by",
         {{letter('A'), next_array, Chord::control},
          {letter('U'), next_color_array, Chord::control}}},
        {"V", "next stereo mode", {{letter('V'), next_stereo}}},
        {"P or F12", "screenshot", {{letter('P'), screenshot}, {Key::f12, screenshot}}},
        {"Ctrl + C, Ctrl + S",
         "copy the value under the cursor or mark; save the session",
         {{letter('C'), copy, Chord::control}, {letter('S'), save_session, Chord::control}}},
        {"Ctrl + X",
         "export the surfaces as files (again: cancel)",
         {{letter('X'), export_surfaces, Chord::control}}},
        {"M", "stamp this moment in the recording", {{letter('M'), stamp}}},
        {"Tab", "panel on, off", {{Key::tab, panel}}},
        {"Y", "panel in the room, beside the data: on, off", {{letter('Y'), room_panel}}},
        {"Enter",
         "pick the surface under the cursor, or where the wand points",
         {{Key::enter, pick}}},
        {"Insert", "read the data under the cursor, or at the wand's tip", {{Key::insert, probe}}},
        {"Ctrl + Z, Ctrl + Shift + Z",
         "undo, redo",
         {{letter('Z'), undo, Chord::control}, {letter('Z'), redo, Chord::control_shift}}},
        {"4 5 6",
         "tool of mouse and wand: pick and grab, clip plane, ruler",
         {{letter('4'), first_tools}, {letter('5'), clip_tool}, {letter('6'), ruler_tool}}},
        {"7, Ctrl + 7",
         "clip plane across the next axis, cut away the other side",
         {{letter('7'), snap_clip}, {letter('7'), flip_clip, Chord::control}}},
        {"Delete", "remove the tool's clip plane, ruler or mark", {{Key::del, remove_made}}},
        {"Escape", "leave the tool; else ask whether to quit (Enter: yes)", {{Key::escape, quit}}},
        {"Ctrl + Q", "ask whether to quit", {{letter('Q'), ask_to_quit, Chord::control}}},
        {"Shift, Ctrl",
         "Shift: walk and fly three times as fast",
         {{Key::left_shift, shift},
          {Key::right_shift, shift},
          {Key::left_control, control},
          {Key::right_control, control}}},
    };
    return lines;
}

std::span<const ControlLine> control_lines() {
    using enum DeviceKind;
    static constexpr std::array<ControlLine, 37> kLines{{
        {mouse, "Click", "pick the surface there, or what the tool does (4 5 6)"},
        {mouse, "Double click", "bring that place of a surface to the middle of the view"},
        {mouse, "Left drag", "orbit: turn the volume about its center"},
        {mouse, "Middle drag, or Shift + left", "move the volume"},
        {mouse, "Right drag", "look around"},
        {mouse, "Wheel", "scale about the place under the cursor"},
        {mouse, "Ctrl + wheel", "isovalue by 0.1 % of the range"},
        {mouse, "Mouse", "aims the wand"},
        {keyboard, "F1 or ?", "help: keys, mouse and devices"},
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
