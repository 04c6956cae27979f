// The window for choosing one of the arrays that files have.
#include "app/panel/array_window.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/theme.h"

#include <imgui.h>

#include <algorithm>

namespace isochron::app {
namespace {

bool goes_down(ImGuiKey key) {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key));
}

void cell(const std::string& words, Ink ink) {
    ImGui::TableNextColumn();
    fitted_text(words, ImGui::GetContentRegionAvail().x, color_of(ink));
}

} // namespace

/// @return whether a line was clicked twice
bool ArrayWindow::draw_lines(const std::vector<ListedArray>& arrays, bool moved) {
    bool opened = false;
    constexpr ImGuiTableFlags kTable = ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingStretchProp;
    const float height = std::min(ImGui::GetContentRegionAvail().y - 34.0f,
                                  ImGui::GetTextLineHeightWithSpacing() *
                                      (static_cast<float>(arrays.size()) + 1.5f));
    if (!ImGui::BeginTable("arrays", 4, kTable, {0.0f, height}))
        return false;
    ImGui::TableSetupColumn("array", 0, 2.2f);
    ImGui::TableSetupColumn("grid", 0, 2.4f);
    ImGui::TableSetupColumn("unit", 0, 0.8f);
    ImGui::TableSetupColumn("values, first step", 0, 1.8f);
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableHeadersRow();
    for (std::size_t i = 0; i < arrays.size(); ++i) {
        const ListedArray& line = arrays[i];
        const bool can = line.fault.empty();
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::Selectable("##line", i == chosen_,
                              ImGuiSelectableFlags_SpanAllColumns |
                                  ImGuiSelectableFlags_AllowDoubleClick)) {
            chosen_ = i;
            opened = can && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
        }
        if (!can)
            tip(line.fault.c_str());
        if (i == chosen_ && moved)
            ImGui::SetScrollHereY();
        ImGui::SameLine(0.0f, 0.0f);
        fitted_text(line.name, ImGui::GetContentRegionAvail().x,
                    color_of(can ? Ink::text : Ink::dim));
        cell(can ? line.grid : line.fault, i == chosen_ ? Ink::text : Ink::dim);
        cell(line.unit, i == chosen_ ? Ink::text : Ink::dim);
        cell(line.values, i == chosen_ ? Ink::text : Ink::dim);
        ImGui::PopID();
    }
    ImGui::EndTable();
    return opened;
}

std::optional<std::size_t> ArrayWindow::draw(const std::string& file,
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
    ImGui::Begin("###choose", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings);
    note("Which array of " + file + "? Those of its shape can be shown with it.",
         color_of(Ink::text));
    ImGui::CaptureKeyboardFromApp(); // so that a key that goes down and up in one frame is seen
    const bool opened = draw_lines(arrays, fresh || way != 0);
    const bool can = arrays[*chosen_].fault.empty();
    ImGui::BeginDisabled(!can);
    const bool asked = ImGui::Button("Open (Enter)");
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::TextColored(color_of(Ink::dim), "Escape cancels");
    ImGui::End();
    return can && (opened || asked || goes_down(ImGuiKey_Enter)) ? chosen_ : std::nullopt;
}

} // namespace isochron::app
