// The search of commands: the user types what they want, sees its key, and runs it.
#include "app/panel/parts/key_search.h"

#include "app/panel/imgui/number_entry.h"
#include "app/panel/panel_words.h"
#include "app/panel/parts/theme.h"
#include "app/text.h"
#include "interaction/controls/action_table.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace isochron::app {
namespace {

using interaction::Chord;
using interaction::Key;
using interaction::KeyEvent;
using interaction::Modifier;

constexpr const char* kNothing = "no command has these words";

std::vector<KeyCommand> all_key_commands() {
    std::vector<KeyCommand> all{
        {"open other data", "Ctrl + O", Key{'O'}, Chord::control, {}, false},
        {"arrays: choose by name, values, unit and grid", "Ctrl + Shift + A", Key{'A'},
         Chord::control_shift},
        {"help: keys, mouse and devices", "F1", Key::f1, Chord::none, {}, false},
        {"full screen on, off", "F11", Key::f11, Chord::none, {}, false}};
    for (const interaction::KeyLine& line : interaction::key_lines())
        for (const interaction::ActionRow& row : line.actions)
            if (!row.keys.empty() && !(row.traits & interaction::kHeld))
                all.push_back({row.words.empty() ? line.effect : row.words, name_of(row.keys[0]),
                               row.keys[0].key, row.keys[0].chord, row.action});
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
