// The search of commands.
#include "app/panel/parts/key_search.h"

#include "app/panel/imgui/number_entry.h"
#include "app/panel/panel_words.h"
#include "app/panel/parts/theme.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace isochron::app {
namespace {

constexpr const char* kOnlyNear =
    "nothing has all these words; nearest, and docs/guide/exploring.md:";
constexpr const char* kHint = "what do you want to do?";

/// What a line reads: `opacity of the surface: 40 %`, with the number that was typed.
std::string shown_words(const SearchLine& line, const std::optional<double>& number) {
    const std::string value =
        number && line.with_number ? line.with_number(*number).words : line.value;
    return value.empty() ? line.words : line.words + ": " + value;
}

/// What stands at the right end of a line.
const char* note_of(const SearchLine& line, const std::optional<double>& number) {
    if (!line.key.empty())
        return line.key.c_str();
    if (line.with_number && !number)
        return "type a number";
    return line.section ? "in the panel" : "";
}

} // namespace

void KeySearch::open() {
    shown_ = fresh_ = true;
    text_.clear();
    chosen_ = 0;
    moved_ = false;
}

/// The lines as a list. @return the one that the user chooses
const SearchLine* KeySearch::chosen_line(const Ranking& found, bool moved) {
    const SearchLine* wanted = nullptr;
    if (!found.lines.empty() && (moved_ || !found.only_near) &&
        ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter)))
        wanted = found.lines[static_cast<std::size_t>(chosen_)];
    if (found.only_near)
        note(kOnlyNear, color_of(Ink::dim));
    ImGui::BeginChild("lines");
    for (int i = 0; i < static_cast<int>(found.lines.size()); ++i) {
        const SearchLine& line = *found.lines[static_cast<std::size_t>(i)];
        ImGui::PushID(i);
        const std::string words = shown_words(line, found.number);
        if (ImGui::Selectable(words.c_str(), i == chosen_))
            wanted = &line;
        if (i == chosen_ && moved)
            ImGui::SetScrollHereY();
        const char* const beside = note_of(line, found.number);
        const float width = ImGui::CalcTextSize(beside).x, end = ImGui::GetContentRegionMax().x;
        if (ImGui::CalcTextSize(words.c_str()).x + width + 16.0f < end) {
            ImGui::SameLine(end - width - 4.0f);
            ImGui::TextColored(color_of(i == chosen_ ? Ink::text : Ink::dim), "%s", beside);
        }
        ImGui::PopID();
    }
    ImGui::EndChild();
    return wanted;
}

const SearchLine* KeySearch::over_picture(const Ranking& found, const PanelBox& picture,
                                          bool& left) {
    constexpr float kWidth = 520.0f, kHeight = 340.0f;
    const float line_height = ImGui::GetTextLineHeightWithSpacing();
    const std::size_t lines =
        std::max(found.lines.size(), std::size_t{1}) + (found.only_near ? 2 : 0);
    const float height = 58.0f + line_height * static_cast<float>(lines);
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
    if (text_field("##search", kHint, text_)) {
        chosen_ = 0;
        moved_ = false;
    }
    const auto pressed = [](ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); };
    const int last = std::max(0, static_cast<int>(found.lines.size()) - 1);
    const bool moved = pressed(ImGuiKey_DownArrow) || pressed(ImGuiKey_UpArrow);
    if (pressed(ImGuiKey_DownArrow))
        ++chosen_;
    if (pressed(ImGuiKey_UpArrow))
        --chosen_;
    moved_ = moved_ || moved;
    chosen_ = std::clamp(chosen_, 0, last);
    const SearchLine* const wanted = chosen_line(found, moved);
    left = !ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows) &&
           ImGui::IsMouseClicked(ImGuiMouseButton_Left);
    ImGui::End();
    return wanted;
}

/// The lines, high enough for a ray. @return the one that the user chooses
const SearchLine* KeySearch::line_in_room(const Ranking& found) {
    constexpr float kLine = 30.0f, kGap = 12.0f;
    const SearchLine* wanted = nullptr;
    if (found.only_near)
        note(kOnlyNear, color_of(Ink::dim));
    for (std::size_t i = 0; i < found.lines.size(); ++i) {
        const SearchLine& line = *found.lines[i];
        ImGui::PushID(static_cast<int>(i));
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        const float width = ImGui::GetContentRegionAvail().x;
        if (ImGui::Selectable("##line", false, 0, {0.0f, kLine}))
            wanted = &line;
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const float y = corner.y + (kLine - ImGui::GetFontSize()) / 2;
        const std::string words = shown_words(line, found.number);
        const char* const beside = note_of(line, found.number);
        const float key = ImGui::CalcTextSize(beside).x;
        list.AddText({corner.x + 4.0f, y}, packed(Ink::text), words.c_str());
        if (ImGui::CalcTextSize(words.c_str()).x + key + kGap < width)
            list.AddText({corner.x + width - key - 4.0f, y}, packed(Ink::dim), beside);
        ImGui::PopID();
    }
    return wanted;
}

const SearchLine* KeySearch::in_room(const Ranking& found, const PanelBox& place, bool& left) {
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
    finished_text("##search", kHint, text_);
    ImGui::SameLine();
    left = ImGui::Button("Close", {kClose, 0.0f});
    ImGui::BeginChild("lines");
    const SearchLine* const wanted = line_in_room(found);
    ImGui::EndChild();
    ImGui::End();
    ImGui::PopStyleVar();
    return wanted;
}

std::optional<SearchLine> KeySearch::draw(const PanelModel& model, const PanelBox& place) {
    if (!shown_)
        return std::nullopt;
    const bool room = model.place == PanelPlace::in_room;
    std::vector<SearchLine> lines = search_lines(model);
    if (room) // no other data, and no window of the desktop
        std::erase_if(lines, [](const SearchLine& line) { return !line.in_room; });
    const Ranking found = ranked(lines, text_);
    bool left = false;
    const SearchLine* const wanted =
        room ? in_room(found, place, left) : over_picture(found, place, left);
    if (wanted || left)
        shown_ = false;
    if (!wanted)
        return std::nullopt;
    SearchLine chosen = *wanted;
    if (found.number && chosen.with_number) {
        chosen.commands = chosen.with_number(*found.number).commands;
        chosen.section.reset();
    }
    return chosen;
}

} // namespace isochron::app
