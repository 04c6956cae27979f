// The window for choosing one of the arrays of the data.
#include "app/panel/array_window.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/theme.h"

#include <imgui.h>

#include <algorithm>

namespace isochron::app {
namespace {

constexpr ImGuiWindowFlags kAlone =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;

bool goes_down(ImGuiKey key) {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key));
}

void cell(const std::string& words, Ink ink) {
    ImGui::TableNextColumn();
    fitted_text(words, ImGui::GetContentRegionAvail().x, color_of(ink));
}

/// An array in two lines, as a wide button. @return whether it was pressed
bool pressed_in_room(const ListedArray& line, bool shown) {
    const float height = 2 * ImGui::GetTextLineHeight() + 10.0f;
    const ImVec2 corner = ImGui::GetCursorPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const bool pressed = ImGui::Selectable("##line", shown, 0, {0.0f, height});
    const ImVec2 next = ImGui::GetCursorPos();
    ImGui::SetCursorPos({corner.x + 4.0f, corner.y + 4.0f});
    fitted_text(line.name, width - 8.0f, color_of(Ink::text));
    ImGui::SetCursorPos({corner.x + 4.0f, corner.y + 4.0f + ImGui::GetTextLineHeight()});
    fitted_text(line.values + (line.unit.empty() ? "" : " " + line.unit), width - 8.0f,
                color_of(shown ? Ink::text : Ink::dim));
    ImGui::SetCursorPos(next);
    return pressed;
}

/// A column as wide as its widest words, where the table has room for all columns.
void column(const char* title, const std::vector<ListedArray>& arrays,
            std::string ListedArray::* words) {
    constexpr float kBeside = 12.0f;
    float widest = ImGui::CalcTextSize(title).x;
    for (const ListedArray& each : arrays)
        widest = std::max(widest, ImGui::CalcTextSize((each.*words).c_str()).x);
    ImGui::TableSetupColumn(title, 0, widest + kBeside);
}

} // namespace

/// @return whether a line was clicked twice
bool ArrayWindow::draw_lines(const std::vector<ListedArray>& arrays, const char* values,
                             bool moved) {
    bool opened = false;
    constexpr ImGuiTableFlags kTable = ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingStretchProp;
    const float height = std::min(ImGui::GetContentRegionAvail().y - 34.0f,
                                  ImGui::GetTextLineHeightWithSpacing() *
                                      (static_cast<float>(arrays.size()) + 1.5f));
    if (!ImGui::BeginTable("arrays", 4, kTable, {0.0f, height}))
        return false;
    column("array", arrays, &ListedArray::name);
    column(values, arrays, &ListedArray::values);
    column("unit", arrays, &ListedArray::unit);
    column("grid", arrays, &ListedArray::grid);
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableHeadersRow();
    for (std::size_t i = 0; i < arrays.size(); ++i) {
        const ListedArray& line = arrays[i];
        const bool can = line.fault.empty();
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::PushID(static_cast<int>(i));
        if (const LinePress press = table_line(i == chosen_); press != LinePress::none) {
            chosen_ = i;
            opened = can && press == LinePress::twice;
        }
        if (!can)
            tip(line.fault.c_str());
        if (i == chosen_ && moved)
            ImGui::SetScrollHereY();
        ImGui::SameLine(0.0f, 0.0f);
        fitted_text(line.name, ImGui::GetContentRegionAvail().x,
                    color_of(can ? Ink::text : Ink::dim));
        const Ink ink = i == chosen_ ? Ink::text : Ink::dim;
        cell(line.values, ink);
        cell(line.unit, ink);
        cell(can ? line.grid : line.fault, ink);
        ImGui::PopID();
    }
    ImGui::EndTable();
    return opened;
}

std::optional<std::size_t> ArrayWindow::draw(const ArrayQuestion& words,
                                             const std::vector<ListedArray>& arrays,
                                             std::size_t first) {
    const auto last = static_cast<int>(arrays.size()) - 1;
    const int way = (goes_down(ImGuiKey_DownArrow) ? 1 : 0) - (goes_down(ImGuiKey_UpArrow) ? 1 : 0);
    const bool fresh = !chosen_;
    chosen_ = static_cast<std::size_t>(
        std::clamp(static_cast<int>(chosen_.value_or(first)) + way, 0, last));
    const ImVec2 picture = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({picture.x / 2, picture.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    const float lines =
        ImGui::GetTextLineHeightWithSpacing() * (static_cast<float>(arrays.size()) + 4);
    ImGui::SetNextWindowSize(
        {std::min(0.96f * picture.x, 640.0f), std::min(0.84f * picture.y, 30.0f + lines)});
    if (fresh)
        ImGui::SetNextWindowFocus();
    ImGui::Begin("###choose", nullptr, kAlone);
    note(words.question, color_of(Ink::text));
    ImGui::CaptureKeyboardFromApp(); // so that a key that goes down and up in one frame is seen
    const bool opened = draw_lines(arrays, words.values, fresh || way != 0);
    const bool can = arrays[*chosen_].fault.empty();
    ImGui::BeginDisabled(!can);
    const bool asked = ImGui::Button(words.button);
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::TextColored(color_of(Ink::dim), "Escape cancels");
    ImGui::End();
    return can && (opened || asked || goes_down(ImGuiKey_Enter)) ? chosen_ : std::nullopt;
}

std::optional<std::size_t> ArrayWindow::draw_in_room(const PanelBox& place,
                                                     const std::vector<ListedArray>& arrays,
                                                     std::size_t first, bool& left) {
    constexpr float kClose = 80.0f;
    ImGui::SetNextWindowPos({place.low.x, place.low.y});
    ImGui::SetNextWindowSize({place.size().x, place.size().y});
    if (!chosen_)
        ImGui::SetNextWindowFocus();
    chosen_ = first;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
    ImGui::Begin("###choose", nullptr, kAlone);
    ImGui::AlignTextToFramePadding();
    text("arrays of these data");
    ImGui::SameLine(ImGui::GetContentRegionMax().x - kClose);
    left = ImGui::Button("Close", {kClose, 0.0f});
    std::optional<std::size_t> pressed;
    ImGui::BeginChild("lines");
    for (std::size_t i = 0; i < arrays.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        if (pressed_in_room(arrays[i], i == first))
            pressed = i;
        ImGui::PopID();
    }
    ImGui::EndChild();
    ImGui::End();
    ImGui::PopStyleVar();
    return pressed;
}

} // namespace isochron::app
