// The search of commands: the user types what they want, sees its key, and runs it.
#include "app/panel/parts/key_search.h"

#include "app/panel/number_entry.h"
#include "app/panel/panel_words.h"
#include "app/panel/parts/theme.h"
#include "app/text.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace isochron::app {
namespace {

using interaction::Action;
using interaction::Chord;
using interaction::Key;
using interaction::KeyEvent;
using interaction::Modifier;

constexpr const char* kNothing = "no command has these words";

/// What these actions do while their keys are held, or with the mouse; a press alone does nothing.
constexpr std::array kHeld{Action::walk_forward, Action::walk_back,     Action::walk_left,
                           Action::walk_right,   Action::walk_up,       Action::walk_down,
                           Action::shift,        Action::control,       Action::grab,
                           Action::fly,          Action::grow,          Action::shrink,
                           Action::teleport,     Action::isovalue_rise, Action::isovalue_fall,
                           Action::pick,         Action::probe};

/// Words for actions that share a line of the table of keys with others.
constexpr std::pair<Action, const char*> kWords[]{
    {Action::isovalue_up, "raise the isovalue"},
    {Action::isovalue_down, "lower the isovalue"},
    {Action::step_forward, "one step forward"},
    {Action::step_back, "one step back"},
    {Action::faster, "play twice as fast"},
    {Action::slower, "play half as fast"},
    {Action::axis_view, "look along the next axis"},
    {Action::isometric_view, "isometric view: look from a corner"},
    {Action::exaggerate, "exaggerate heights (z) more"},
    {Action::flatten, "exaggerate heights (z) less"},
    {Action::turn_left, "turn to the left by 30 degrees"},
    {Action::turn_right, "turn to the right by 30 degrees"},
    {Action::save_view, "save this viewpoint"},
    {Action::next_view, "go to the next saved viewpoint"},
    {Action::quality_auto, "quality: automatic"},
    {Action::quality_fast, "quality: fast"},
    {Action::quality_best, "quality: best"},
    {Action::quality_paper, "quality: as in the paper"},
    {Action::eyes_apart, "eyes 1 mm further apart"},
    {Action::eyes_together, "eyes 1 mm closer together"},
    {Action::next_array, "next array of the surfaces"},
    {Action::next_color_array, "next array to color by"},
    {Action::undo, "undo"},
    {Action::redo, "redo"},
    {Action::first_tools, "tool: pick and grab"},
    {Action::clip_tool, "tool: clip plane"},
    {Action::ruler_tool, "tool: ruler (measures a length)"},
    {Action::loop, "loop: start again after the last step"},
    {Action::ping_pong, "play back and forth: on, off"},
    {Action::between_steps, "between steps: blend them, or hold the step before"},
    {Action::range_first, "begin playing at this step"},
    {Action::range_last, "end playing at this step"},
    {Action::range_all, "play all steps"},
    {Action::first_step, "go to the first step"},
    {Action::last_step, "go to the last step"},
    {Action::skip_more, "skip more steps while time plays"},
    {Action::skip_fewer, "skip fewer steps while time plays"},
    {Action::save_time, "bookmark this step, or remove its bookmark"},
    {Action::next_time, "go to the next bookmark"},
    {Action::previous_time, "go to the previous bookmark"},
    {Action::save_session, "save the session now"},
    {Action::export_surfaces, "export the surfaces as files, or cancel the export"},
    {Action::flip_clip, "clip plane: cut away the other side"},
};

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

KeyCommand command_of(const interaction::KeyLine& line, const interaction::KeyBinding& binding) {
    const auto* words =
        std::ranges::find(kWords, binding.action, &std::pair<Action, const char*>::first);
    const char* with = binding.chord == Chord::control_shift ? "Ctrl + Shift + "
                       : binding.chord == Chord::control     ? "Ctrl + "
                                                             : "";
    return {words == std::end(kWords) ? std::string(line.effect) : words->second,
            with + name_of_key(binding.key), binding.key, binding.chord, binding.action};
}

std::vector<KeyCommand> all_key_commands() {
    std::vector<KeyCommand> all{
        {"open other data", "Ctrl + O", Key{'O'}, Chord::control, {}, false},
        {"arrays: choose by name, values, unit and grid", "Ctrl + Shift + A", Key{'A'},
         Chord::control_shift},
        {"help: keys, mouse and devices", "F1", Key::f1, Chord::none, {}, false},
        {"full screen on, off", "F11", Key::f11, Chord::none, {}, false}};
    std::vector<Action> listed(kHeld.begin(), kHeld.end());
    for (const interaction::KeyLine& line : interaction::key_lines())
        for (const interaction::KeyBinding& binding : line.bindings) {
            if (std::ranges::find(listed, binding.action) != listed.end())
                continue;
            listed.push_back(binding.action);
            all.push_back(command_of(line, binding));
        }
    return all;
}

} // namespace

const std::vector<KeyCommand>& key_commands() {
    static const std::vector<KeyCommand> all = all_key_commands();
    return all;
}

std::vector<interaction::WindowEvent> presses_of(const KeyCommand& command) {
    const auto modifiers = command.chord == Chord::none
                               ? std::uint8_t{0}
                               : static_cast<std::uint8_t>(Modifier::control);
    std::vector<interaction::WindowEvent> events;
    const auto add = [&](Key key, bool down) {
        events.emplace_back(KeyEvent{key, down, modifiers});
    };
    const bool shift = command.chord == Chord::control_shift;
    if (shift)
        add(Key::left_shift, true);
    add(command.key, true);
    add(command.key, false);
    if (shift)
        add(Key::left_shift, false);
    return events;
}

std::vector<const KeyCommand*> found(std::string_view text) {
    std::vector<const KeyCommand*> all;
    for (const KeyCommand& each : key_commands())
        if (has_words(each.words + " " + each.name, text))
            all.push_back(&each);
    return all;
}

void KeySearch::open() {
    shown_ = fresh_ = true;
    text_.clear();
    chosen_ = 0;
}

/// The keys with the words that were typed, then the settings. In the room only what a hand there can
/// do: no other data, and no window of the desktop.
std::vector<KeySearch::Line> KeySearch::lines_of(const std::vector<FoundSetting>& settings,
                                                 bool in_room) const {
    std::vector<Line> lines;
    for (const KeyCommand* key : found(text_))
        if (key->in_room || !in_room)
            lines.push_back({.key = key});
    for (const FoundSetting& setting : settings)
        lines.push_back({.setting = &setting});
    return lines;
}

/// The lines as a list. @return the one that the user chooses
KeySearch::Line KeySearch::chosen_line(const std::vector<Line>& lines, bool moved) {
    Line wanted;
    if (!lines.empty() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter)))
        wanted = lines[static_cast<std::size_t>(chosen_)];
    ImGui::BeginChild("lines");
    for (int i = 0; i < static_cast<int>(lines.size()); ++i) {
        const Line& line = lines[static_cast<std::size_t>(i)];
        ImGui::PushID(i);
        if (ImGui::Selectable(line.words().c_str(), i == chosen_))
            wanted = line;
        if (i == chosen_ && moved)
            ImGui::SetScrollHereY();
        const std::string name = line.name();
        const float key = ImGui::CalcTextSize(name.c_str()).x;
        ImGui::SameLine(ImGui::GetContentRegionMax().x - key - 4.0f);
        ImGui::TextColored(color_of(i == chosen_ ? Ink::text : Ink::dim), "%s", name.c_str());
        ImGui::PopID();
    }
    if (lines.empty())
        note(kNothing, color_of(Ink::dim));
    ImGui::EndChild();
    return wanted;
}

std::vector<interaction::WindowEvent>
KeySearch::draw(const PanelModel& model, const PanelBox& picture, interaction::Commands& commands) {
    if (!shown_)
        return {};
    constexpr float kWidth = 460.0f, kHeight = 340.0f;
    const std::vector<FoundSetting> settings = found_settings(text_, model);
    const std::vector<Line> lines = lines_of(settings, false);
    const float line_height = ImGui::GetTextLineHeightWithSpacing();
    const float height =
        58.0f + line_height * static_cast<float>(std::max(lines.size(), std::size_t{1}));
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float width = std::min(kWidth, 0.96f * screen.x);
    ImGui::SetNextWindowPos({(screen.x - width) / 2, picture.low.y + 10.0f});
    ImGui::SetNextWindowSize({width, std::min({kHeight, height, std::floor(0.8f * screen.y)})});
    if (fresh_)
        ImGui::SetNextWindowFocus();
    ImGui::Begin("###search", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings);
    fresh_ = false;
    if (!ImGui::IsAnyItemActive()) // it has the keyboard as long as the search is open
        ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-1.0f);
    if (text_field("##search", "what do you want to do?", text_))
        chosen_ = 0;
    const auto pressed = [](ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); };
    const int last = std::max(0, static_cast<int>(lines.size()) - 1);
    const bool moved = pressed(ImGuiKey_DownArrow) || pressed(ImGuiKey_UpArrow);
    if (pressed(ImGuiKey_DownArrow))
        ++chosen_;
    if (pressed(ImGuiKey_UpArrow))
        --chosen_;
    chosen_ = std::clamp(chosen_, 0, last);
    const Line wanted = chosen_line(lines, moved);
    const bool left = !ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows) &&
                      ImGui::IsMouseClicked(ImGuiMouseButton_Left);
    ImGui::End();
    if (wanted || left)
        shown_ = false;
    if (wanted.setting)
        interaction::merge(commands, wanted.setting->commands);
    return wanted.key ? presses_of(*wanted.key) : std::vector<interaction::WindowEvent>();
}

/// The lines, high enough for a ray. @return the one that the user chooses
KeySearch::Line KeySearch::line_in_room(const std::vector<Line>& lines) {
    constexpr float kLine = 30.0f, kGap = 12.0f;
    Line wanted;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const Line& line = lines[i];
        ImGui::PushID(static_cast<int>(i));
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        const float width = ImGui::GetContentRegionAvail().x;
        if (ImGui::Selectable("##line", false, 0, {0.0f, kLine}))
            wanted = line;
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const float y = corner.y + (kLine - ImGui::GetFontSize()) / 2;
        const std::string name = line.name();
        const float words = ImGui::CalcTextSize(line.words().c_str()).x;
        const float key = ImGui::CalcTextSize(name.c_str()).x;
        list.AddText({corner.x + 4.0f, y}, packed(Ink::text), line.words().c_str());
        if (words + key + kGap < width)
            list.AddText({corner.x + width - key - 4.0f, y}, packed(Ink::dim), name.c_str());
        ImGui::PopID();
    }
    if (lines.empty())
        note(kNothing, color_of(Ink::dim));
    return wanted;
}

const KeyCommand* KeySearch::draw_in_room(const PanelModel& model, const PanelBox& place,
                                          interaction::Commands& commands) {
    if (!shown_)
        return nullptr;
    ImGui::SetNextWindowPos({place.low.x, place.low.y});
    ImGui::SetNextWindowSize({place.size().x, place.size().y});
    if (std::exchange(fresh_, false))
        ImGui::SetNextWindowFocus();
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
    ImGui::Begin("###search", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings);
    constexpr float kClose = 80.0f;
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - kClose -
                            ImGui::GetStyle().ItemSpacing.x);
    finished_text("##search", "what do you want to do?", text_);
    ImGui::SameLine();
    const bool left = ImGui::Button("Close", {kClose, 0.0f});
    ImGui::BeginChild("lines");
    const std::vector<FoundSetting> settings = found_settings(text_, model);
    const Line wanted = line_in_room(lines_of(settings, true));
    ImGui::EndChild();
    ImGui::End();
    ImGui::PopStyleVar();
    if (wanted || left)
        shown_ = false;
    if (wanted.setting)
        interaction::merge(commands, wanted.setting->commands);
    return wanted.key;
}

} // namespace isochron::app
