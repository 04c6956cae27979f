// The table of all actions.
#include "interaction/controls/action_table.h"

#include "interaction/navigation/navigator.h"
#include "interaction/tools/clip_tool.h"
#include "interaction/tools/ruler_tool.h"
#include "interaction/tools/slice_tool.h"
#include "interaction/tools/tool_table.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

namespace isochron::interaction {
namespace {

// Effects. A setting that is on or off, a quality and a request need nothing but their row.

template <auto setting, auto change>
void toggle(const Press& p) {
    p.commands.*change = !(p.context.settings.*setting);
}

template <QualityMode mode>
void choose(const Press& p) {
    if (p.context.settings.quality != mode)
        p.commands.quality = mode;
}

template <auto request>
void ask_for(const Press& p) {
    p.commands.*request = true;
}

void follow_last_step(const Press& p) {
    const std::vector<double>* times = p.context.series.times;
    p.commands.follow = !p.context.settings.follow;
    if (*p.commands.follow && times && !times->empty())
        p.commands.instant.emplace(static_cast<std::uint32_t>(times->size()) - 1);
}

/// Saves the volume's place in this frame under the next free name; drops the oldest view if there
/// are `kMostViews`.
void save_this_view(const Press& p) {
    const Settings& settings = p.context.settings;
    p.commands.views = with_view(
        settings.views, p.commands.room_from_physical.value_or(settings.room_from_physical));
    p.notes.push_back(
        fmt::format("viewpoint {} saved: N goes there", p.commands.views->back().name));
}

void pick_next_surface(const Press& p) {
    const auto surfaces = static_cast<std::uint32_t>(p.context.settings.isosurfaces.size());
    if (surfaces > 1)
        p.commands.picked = (p.context.settings.picked + 1) % surfaces;
}

bool has_colors(const ControlContext& context) {
    return context.color_arrays.names && !context.color_arrays.names->empty();
}

/// The range belonged to the previous quantity, so it is dropped.
void color_by_next_quantity(const Press& p) {
    Coloring changed = p.context.settings.coloring;
    changed.by =
        static_cast<ColorBy>((static_cast<std::size_t>(changed.by) + 1) % kNames<ColorBy>.size());
    if (changed.by == ColorBy::value && !has_colors(p.context))
        changed.by = ColorBy::first_crossing;
    changed.range.reset();
    p.commands.coloring = changed;
}

/// At first the array that was chosen before, then the one after it.
void color_by_next_array(const Press& p) {
    if (!has_colors(p.context))
        return;
    const std::vector<std::string>& names = *p.context.color_arrays.names;
    Coloring changed = p.context.settings.coloring;
    const bool goes_on = changed.by == ColorBy::value;
    changed.by = ColorBy::value;
    changed.array = names[(p.context.color_arrays.chosen + (goes_on ? 1 : 0)) % names.size()];
    changed.range.reset();
    p.commands.coloring = changed;
}

void show_next_array(const Press& p) {
    if (!p.context.ways.next_array)
        return;
    p.commands.isovalue.reset(); // it was of the array before
    merge(p.commands, *p.context.ways.next_array);
}

void show_next_stereo_mode(const Press& p) {
    if (!p.context.stereo_modes || p.context.stereo_modes->empty())
        return;
    const std::vector<std::string>& modes = *p.context.stereo_modes;
    const auto mode = std::ranges::find(modes, p.context.settings.stereo);
    const bool wraps = mode == modes.end() || mode + 1 == modes.end();
    p.commands.stereo = wraps ? modes.front() : *(mode + 1);
}

void remove_made_by_tool(const Press& p) {
    tool_row(p.context.settings.tools.mouse).remove(p.context.settings, p.commands);
}

/// Hides all marks and rulers; shows them if all are hidden.
void show_annotations(const Press& p) {
    const Settings& settings = p.context.settings;
    Mark mark = settings.mark;
    std::vector<NamedMark> marks = settings.marks;
    Rulers rulers = settings.rulers;
    std::vector<bool*> all;
    if (mark.point)
        all.push_back(&mark.point->shown);
    for (NamedMark& each : marks)
        all.push_back(&each.point.shown);
    for (Ruler& each : rulers.list)
        all.push_back(&each.shown);
    const bool show = std::ranges::none_of(all, [](const bool* shown) { return *shown; });
    for (bool* const shown : all)
        *shown = show;
    if (mark != settings.mark)
        p.commands.mark = mark;
    if (marks != settings.marks)
        p.commands.marks = std::move(marks);
    if (rulers != settings.rulers)
        p.commands.rulers = std::move(rulers);
}

/// A key chooses the tool of mouse and wand; picking brings back the first tools of all hands.
void choose_tool(ToolKind kind, const Press& p) {
    Tools tools = p.commands.tools.value_or(p.context.settings.tools);
    if (kind == ToolKind::pick)
        tools = {};
    else
        tools.mouse = tools.wand = kind;
    if (tools != p.context.settings.tools)
        p.commands.tools = tools;
}

KeyLine tool_line() {
    KeyLine line{tool_keys(), "", {}};
    for (const ToolRow& row : tool_table()) {
        const ToolKind kind = row.kind;
        line.actions.push_back({choice_of(kind),
                                fmt::format("{}_tool", name_of(kind)),
                                row.old_bit,
                                {},
                                kQuiet,
                                fmt::format("tool: {}", row.found_as),
                                [kind](const Press& p) { choose_tool(kind, p); }});
        if (!row.key)
            continue;
        line.actions.back().keys = {*row.key};
        line.effect += line.effect.empty() ? "tool (mouse, wand): " : ", ";
        line.effect += row.found_as.substr(0, row.found_as.find(" ("));
    }
    return line;
}

/// `remove the tool's mark, clip plane or ruler`
std::string removal_words() {
    std::vector<std::string_view> made;
    for (const ToolRow& row : tool_table())
        if (row.made)
            made.push_back(row.makes);
    return fmt::format("remove the tool's {} or {}", fmt::join(made.begin(), made.end() - 1, ", "),
                       made.back());
}

std::vector<KeyLine> all_lines() {
    using enum Action;
    constexpr Chord kCtrl = Chord::control, kCtrlShift = Chord::control_shift;
    std::vector<KeyLine> lines;
    const auto line = [&](const char* keys, std::string effect) {
        lines.push_back({keys, std::move(effect), {}});
    };
    const auto add = [&](Action action, const char* name, int old_bit, std::vector<KeyStroke> keys,
                         unsigned traits = 0, const char* words = "",
                         const ActionEffect& effect = {}) {
        lines.back().actions.push_back(
            {action, name, old_bit, std::move(keys), traits, words, effect});
    };

    line("W A S D", "walk forward, left, back, right");
    add(walk_forward, "walk_forward", 0, {'W'}, kHeld);
    add(walk_left, "walk_left", 2, {'A'}, kHeld);
    add(walk_back, "walk_back", 1, {'S'}, kHeld);
    add(walk_right, "walk_right", 3, {'D'}, kHeld);
    line("E Q", "rise, sink");
    add(walk_up, "walk_up", 4, {'E'}, kHeld);
    add(walk_down, "walk_down", 5, {'Q'}, kHeld);
    line("G (hold)", "grab: the volume follows the wand");
    add(grab, "grab", 8, {'G'}, kHeld);
    line("F (hold)", "fly where the wand points");
    add(fly, "fly", 9, {'F'}, kHeld);
    line("X Z (hold)", "enlarge, shrink the volume");
    add(grow, "grow", 10, {'X'}, kHeld);
    add(shrink, "shrink", 11, {'Z'}, kHeld);
    line("Up Down", "isovalue by 1 % of the range (Shift: 0.1 %)");
    add(isovalue_up, "isovalue_up", 12, {Key::up}, 0, "raise the isovalue");
    add(isovalue_down, "isovalue_down", 13, {Key::down}, 0, "lower the isovalue");
    line("Page Up, Page Down", "the same");
    add(isovalue_rise, "isovalue_rise", 14, {Key::page_up}, kHeld);
    add(isovalue_fall, "isovalue_fall", 15, {Key::page_down}, kHeld);
    line("Right Left, or . ,", "one step forward, back (pauses)");
    add(step_forward, "step_forward", 16, {Key::right, Key::period}, 0, "one step forward");
    add(step_back, "step_back", 17, {Key::left, Key::comma}, 0, "one step back");
    line("Ctrl + Left, Ctrl + Right", "first, last step of the range (or of all steps)");
    add(first_step, "first_step", 67, {{Key::left, kCtrl}}, 0, "go to the first step");
    add(last_step, "last_step", 68, {{Key::right, kCtrl}}, 0, "go to the last step");
    line("Space", "play, pause");
    add(play, "play", 18, {Key::space});
    line("R", "reverse the direction of time");
    add(reverse, "reverse", 19, {'R'});
    line("L, Ctrl + L", "loop, play back and forth: on, off");
    add(loop, "loop", 20, {'L'}, 0, "loop: start again after the last step");
    add(ping_pong, "ping_pong", 63, {{'L', kCtrl}}, kQuiet, "play back and forth: on, off");
    line("Ctrl + , and Ctrl + .", "the range that plays begins, ends here (again: no more)");
    add(range_first, "range_first", 64, {{Key::comma, kCtrl}}, kQuiet,
        "begin playing at this step");
    add(range_last, "range_last", 65, {{Key::period, kCtrl}}, kQuiet, "end playing at this step");
    line("Ctrl + Shift + .", "all steps play again");
    add(range_all, "range_all", 66, {{Key::period, kCtrlShift}}, kQuiet, "play all steps");
    line("Ctrl + +, Ctrl + -", "show only every 2nd, 3rd .. step; more of them again");
    add(skip_more, "skip_more", 69, {{Key::equal, kCtrl}}, kQuiet,
        "skip more steps while time plays");
    add(skip_fewer, "skip_fewer", 70, {{Key::minus, kCtrl}}, kQuiet,
        "skip fewer steps while time plays");
    line("Ctrl + B", "bookmark this time (again: no more)");
    add(save_time, "save_time", 72, {{'B', kCtrl}}, kQuiet,
        "bookmark this step, or remove its bookmark");
    line("Ctrl + N, Ctrl + Shift + N", "next, previous bookmark");
    add(next_time, "next_time", 73, {{'N', kCtrl}}, 0, "go to the next bookmark");
    add(previous_time, "previous_time", 74, {{'N', kCtrlShift}}, 0, "go to the previous bookmark");
    line("End", "follow the last step as new ones come: on, off");
    add(follow, "follow", 54, {Key::end}, 0, "", follow_last_step);
    line("+ -", "play twice, half as fast");
    add(faster, "faster", 21, {Key::equal}, 0, "play twice as fast");
    add(slower, "slower", 22, {Key::minus}, 0, "play half as fast");
    line("Ctrl + R", "speed: of the whole series, steps a second, the data's time");
    add(speed_unit, "speed_unit", 71, {{'R', kCtrl}}, kQuiet);
    line("Ctrl + T", "between two steps: blend them, hold the step before");
    add(between_steps, "between_steps", 79, {{'T', kCtrl}}, kQuiet,
        "between steps: blend them, or hold the step before", [](const Press& p) {
            const bool blends = p.context.settings.between == BetweenSteps::blend;
            p.commands.between = blends ? BetweenSteps::hold : BetweenSteps::blend;
        });
    line("Home", "reset everything (Ctrl + Z undoes it)");
    add(reset, "reset", 23, {Key::home});
    line("8 9", "look along the next axis, from a corner");
    add(axis_view, "axis_view", 56, {'8'}, 0, "look along the next axis");
    add(isometric_view, "isometric_view", 57, {'9'}, 0, "isometric view: look from a corner");
    line("Ctrl + E, Ctrl + Shift + E", "heights (z) more, less exaggerated, by a quarter");
    add(exaggerate, "exaggerate", 59, {{'E', kCtrl}}, 0, "exaggerate heights (z) more");
    add(flatten, "flatten", 60, {{'E', kCtrlShift}}, 0, "exaggerate heights (z) less");
    line("0", "parallel (orthographic) projection on, off");
    add(orthographic, "orthographic", 55, {'0'}, 0, "",
        toggle<&Settings::orthographic, &Commands::orthographic>);
    line("J K", "turn to the left, to the right by 30 degrees");
    add(turn_left, "turn_left", 34, {'J'}, 0, "turn to the left by 30 degrees");
    add(turn_right, "turn_right", 35, {'K'}, 0, "turn to the right by 30 degrees");
    line("T (hold)", "aim at the floor with the wand; letting go teleports there");
    add(teleport, "teleport", 36, {'T'}, kHeld);
    line("C", "recenter: the volume stands ahead of you again");
    add(recenter, "recenter", 37, {'C'});
    line("B N", "save this viewpoint, go to the next saved one");
    add(save_view, "save_view", 38, {'B'}, kQuiet, "save this viewpoint", save_this_view);
    add(next_view, "next_view", 39, {'N'}, 0, "go to the next saved viewpoint");
    line("Ctrl + M, Ctrl + Shift + M", "make what is seen a key of the film, remove this key");
    add(add_key, "add_key", kNoOldBit, {{'M', kCtrl}}, kQuiet,
        "key frame: add what is seen to the film's keys");
    add(remove_key, "remove_key", kNoOldBit, {{'M', kCtrlShift}}, kQuiet,
        "key frame: remove the film's key that is seen, or the last one");
    line("Ctrl + J, Ctrl + Shift + J", "next, previous key of the film");
    add(next_key, "next_key", kNoOldBit, {{'J', kCtrl}}, 0, "key frame: go to the next one");
    add(previous_key, "previous_key", kNoOldBit, {{'J', kCtrlShift}}, 0,
        "key frame: go to the previous one");
    line("Ctrl + Page Down, Ctrl + Page Up", "next, previous step of the story, if keys have texts");
    add(next_told, "next_told", kNoOldBit, {{Key::page_down, kCtrl}}, 0,
        "story: tell the next step, or begin it");
    add(previous_told, "previous_told", kNoOldBit, {{Key::page_up, kCtrl}}, 0,
        "story: tell the previous step");
    line("Ctrl + Shift + Page Up", "leave the story (Escape, too)");
    add(leave_story, "leave_story", kNoOldBit, {{Key::page_up, kCtrlShift}}, kQuiet,
        "story: leave it");
    line("H", "floor grid on, off");
    add(grid, "grid", 40, {'H'}, 0, "", toggle<&Settings::grid, &Commands::grid>);
    line("1 2 3, Ctrl + 1", "quality: automatic, fast, best, as in the paper");
    add(quality_auto, "quality_auto", 24, {'1'}, kQuiet, "quality: automatic",
        choose<QualityMode::automatic>);
    add(quality_fast, "quality_fast", 25, {'2'}, kQuiet, "quality: fast",
        choose<QualityMode::fast>);
    add(quality_best, "quality_best", 26, {'3'}, kQuiet, "quality: best",
        choose<QualityMode::quality>);
    add(quality_paper, "quality_paper", 58, {{'1', kCtrl}}, kQuiet, "quality: as in the paper",
        choose<QualityMode::paper>);
    line("Ctrl + G", "lift a dark background where colors show values: on, off");
    add(lift_background, "lift_background", kNoOldBit, {{'G', kCtrl}}, kQuiet,
        "background: lift it where colors show values", [](const Press& p) {
            Look look = p.context.settings.look;
            look.lifts = !look.lifts;
            p.commands.look = look;
            p.notes.emplace_back(look.lifts ? "a dark background is lifted where colors show values"
                                            : "the background stays as dark as it is chosen");
        });
    line("] [", "eyes 1 mm further apart, closer together");
    add(eyes_apart, "eyes_apart", 27, {Key::right_bracket}, 0, "eyes 1 mm further apart");
    add(eyes_together, "eyes_together", 28, {Key::left_bracket}, 0, "eyes 1 mm closer together");
    line("O", "box with ticks and numbers on, off");
    add(bounding_box, "bounding_box", 41, {'O'}, kQuiet, "",
        toggle<&Settings::bounding_box, &Commands::bounding_box>);
    line("I", "next isosurface: the one that the isovalue moves");
    add(next_surface, "next_surface", 42, {'I'}, kQuiet, "", pick_next_surface);
    line("U", "color by surface, array, time of first crossing");
    add(next_coloring, "next_coloring", 43, {'U'}, 0, "", color_by_next_quantity);
    line("Ctrl + A, Ctrl + U", "next array of the surfaces, next array to color by");
    add(next_array, "next_array", 61, {{'A', kCtrl}}, 0, "next array of the surfaces",
        show_next_array);
    add(next_color_array, "next_color_array", 62, {{'U', kCtrl}}, 0, "next array to color by",
        color_by_next_array);
    line("V", "next stereo mode");
    add(next_stereo, "next_stereo", 29, {'V'}, 0, "", show_next_stereo_mode);
    line("P or F12", "screenshot");
    add(screenshot, "screenshot", 30, {'P', Key::f12}, kQuiet, "", ask_for<&Commands::screenshot>);
    line("Ctrl + C, Ctrl + S", "copy the value under the cursor or mark; save the session");
    add(copy, "copy", 75, {{'C', kCtrl}}, kQuiet, "", ask_for<&Commands::copy>);
    add(save_session, "save_session", 76, {{'S', kCtrl}}, kQuiet, "save the session now",
        ask_for<&Commands::save>);
    line("Ctrl + X", "export the surfaces as files (again: cancel)");
    add(export_surfaces, "export_surfaces", 80, {{'X', kCtrl}}, kQuiet,
        "export the surfaces as files, or cancel the export", [](const Press& p) {
            p.commands.exporting = ExportWork{.goes_on = !p.context.settings.exporting.goes_on};
        });
    line("M", "stamp this moment in the recording");
    add(stamp, "stamp", 31, {'M'}, kQuiet);
    line("Tab", "panel on, off");
    add(panel, "panel", 32, {Key::tab}, kQuiet, "", toggle<&Settings::panel, &Commands::panel>);
    line("Ctrl + D", "curves: area, volume, pieces over all steps: on, off");
    add(curves, "curves", kNoOldBit, {{'D', kCtrl}}, kQuiet,
        "curves over all steps: area, volume, pieces of the surfaces", [](const Press& p) {
            CurveDrawer drawer = p.context.settings.curves;
            drawer.shown = !drawer.shown;
            p.commands.curves = drawer;
        });
    line("Ctrl + Shift + D", "curve: the values along the ruler, on, off");
    add(profile, "profile", kNoOldBit, {{'D', kCtrlShift}}, kQuiet,
        "profile: the values along the ruler", [](const Press& p) {
            p.commands.curves = profile_on_or_off(p.context.settings.curves);
        });
    line("Y", "panel in the room, beside the data: on, off");
    add(room_panel, "room_panel", 44, {'Y'}, kQuiet);
    line("Enter", "pick the surface under the cursor, or where the wand points");
    add(pick, "pick", 45, {Key::enter}, kQuiet | kHeld);
    line("Insert", "read the data under the cursor, or at the wand's tip");
    add(probe, "probe", 46, {Key::insert}, kQuiet | kHeld);
    line("Ctrl + Z, Ctrl + Shift + Z", "undo, redo");
    add(undo, "undo", 47, {{'Z', kCtrl}}, kQuiet, "undo");
    add(redo, "redo", 48, {{'Z', kCtrlShift}}, kQuiet, "redo");
    lines.push_back(tool_line());
    line("7, Ctrl + 7", "clip plane across the next axis, cut away the other side");
    add(snap_clip, "snap_clip", 52, {'7'}, kQuiet, "", [](const Press& p) {
        p.commands.clip = snapped_next(p.context.settings.clip, p.context.data);
    });
    add(flip_clip, "flip_clip", 78, {{'7', kCtrl}}, kQuiet, "clip plane: cut away the other side",
        [](const Press& p) {
            if (p.context.settings.clip.shown)
                p.commands.clip = flipped(p.context.settings.clip);
        });
    line("Ctrl + Shift + R", "the ruler measures angles, by three places, or distances");
    add(ruler_angle, "ruler_angle", kNoOldBit, {{'R', kCtrlShift}}, kQuiet,
        "ruler: angles between three places, or distances", [](const Press& p) {
            const Rulers& rulers = p.context.settings.rulers;
            p.commands.rulers = with_angle(rulers, !rulers.angle);
            p.notes.emplace_back(rulers.angle ? "the next ruler measures a distance"
                                              : "the next ruler measures an angle: three places");
        });
    line("Ctrl + Shift + H", "marks and rulers: hide all, show all");
    add(annotations, "annotations", kNoOldBit, {{'H', kCtrlShift}}, kQuiet, "", show_annotations);
    line("Ctrl + 6, Ctrl + Shift + 6", "slice across the next axis, one more slice");
    add(snap_slice, "snap_slice", kNoOldBit, {{'6', kCtrl}}, kQuiet, "slice across the next axis",
        [](const Press& p) {
            p.commands.slices = snapped_next(p.context.settings.slices, p.context.data);
        });
    add(add_slice, "add_slice", kNoOldBit, {{'6', kCtrlShift}}, kQuiet, "add a slice",
        [](const Press& p) {
            p.commands.slices = with_slice(p.context.settings.slices, p.context.data);
        });
    line("Ctrl + Up, Ctrl + Down", "slice by one cell along its normal, and back");
    add(slice_forward, "slice_forward", kNoOldBit, {{Key::up, kCtrl}}, kQuiet,
        "slice: one cell along its normal", [](const Press& p) {
            p.commands.slices = stepped(p.context.settings.slices, true, p.context.data);
        });
    add(slice_back, "slice_back", kNoOldBit, {{Key::down, kCtrl}}, kQuiet, "slice: one cell back",
        [](const Press& p) {
            p.commands.slices = stepped(p.context.settings.slices, false, p.context.data);
        });
    line("Ctrl + H", "slices alone, without the surfaces: on, off");
    add(slices_alone, "slices_alone", kNoOldBit, {{'H', kCtrl}}, kQuiet,
        "slices alone: hide the surfaces", [](const Press& p) {
            Slices slices = p.context.settings.slices;
            if (!slices.shown())
                slices = with_slice(slices, p.context.data);
            slices.alone = !slices.alone;
            p.commands.slices = slices;
        });
    line("Ctrl + Shift + G", "ghosts: surfaces of earlier and later steps on, off");
    add(ghosts, "ghosts", kNoOldBit, {{'G', kCtrlShift}}, kQuiet,
        "ghosts: surfaces of earlier and later steps", [](const Press& p) {
            p.commands.ghosts = ghosts_on_or_off(p.context.settings.ghosts);
        });
    line("Delete", removal_words());
    add(remove_made, "remove_made", 53, {Key::del}, kQuiet, "", remove_made_by_tool);
    line("Escape", "leave the tool, a story, a list, a page, or loading");
    add(quit, "quit", 33, {Key::escape}, kQuiet); // its name of old recordings: it asked
    line("Ctrl + Q", "ask whether to quit (Enter: yes, Escape: no)");
    add(ask_to_quit, "ask_to_quit", 77, {{'Q', kCtrl}}, kQuiet);
    line("Shift, Ctrl", "Shift: walk and fly three times as fast");
    add(shift, "shift", 6, {Key::left_shift, Key::right_shift}, kQuiet | kHeld);
    add(control, "control", 7, {Key::left_control, Key::right_control}, kQuiet | kHeld);
    return lines;
}

} // namespace

CurveDrawer profile_on_or_off(CurveDrawer curves) {
    const bool profile = curves.shown && curves.measure == kProfileCurve;
    curves.shown = !profile;
    curves.measure = kProfileCurve;
    return curves;
}

Ghosts ghosts_on_or_off(Ghosts ghosts) {
    constexpr std::uint32_t kUsual = 2;
    ghosts.earlier = ghosts.later = ghosts.shown() ? 0 : kUsual;
    if (!(ghosts.opacity > 0))
        ghosts.opacity = Ghosts{}.opacity;
    return ghosts;
}

std::span<const KeyLine> key_lines() {
    static const std::vector<KeyLine> lines = all_lines();
    return lines;
}

namespace {

/// The row of each action, by its number.
const std::array<const ActionRow*, kActions>& rows() {
    static const auto all = [] {
        std::array<const ActionRow*, kActions> found{};
        for (const KeyLine& line : key_lines())
            for (const ActionRow& row : line.actions)
                found[static_cast<std::size_t>(row.action)] = &row;
        return found;
    }();
    return all;
}

std::optional<Action> action_with(auto ActionRow::* member, const auto& value) {
    const auto row =
        std::ranges::find(rows(), value, [&](const ActionRow* each) { return each->*member; });
    return row == rows().end() ? std::nullopt : std::optional((*row)->action);
}

} // namespace

std::string_view name_of(Action action) {
    return rows()[static_cast<std::size_t>(action)]->name;
}

std::optional<Action> action_named(std::string_view name) {
    return action_with(&ActionRow::name, name);
}

std::optional<Action> action_of_old_bit(int bit) {
    return action_with(&ActionRow::old_bit, bit);
}

const ActionSet& quiet_actions() {
    static const ActionSet quiet = [] {
        ActionSet all;
        for (const ActionRow* row : rows())
            if (row->traits & kQuiet)
                all |= bit(row->action);
        return all;
    }();
    return quiet;
}

} // namespace isochron::interaction
