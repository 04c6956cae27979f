// Lines of text in the panel, and tips on its controls.
#include "app/panel/panel_words.h"

#include "app/panel/parts/theme.h"

#include <algorithm>

namespace isochron::app {

void text(const std::string& line) {
    ImGui::TextUnformatted(line.c_str());
}

void note(const std::string& line, const ImVec4& color) {
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::PushTextWrapPos(0.0f);
    text(line);
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

namespace {

/// No wider than the picture that it stands in.
void tooltip(const char* words) {
    constexpr float kWidest = 420.0f;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(std::min(kWidest, 0.9f * ImGui::GetIO().DisplaySize.x));
    ImGui::TextUnformatted(words);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

} // namespace

void tip(const char* words) {
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
        tooltip(words);
}

void popup_title(const char* words) {
    ImGui::TextColored(color_of(Ink::dim), "%s", words);
    ImGui::Separator();
}

void point_at(const ImVec2& low, const ImVec2& high) {
    ImGui::GetWindowDrawList()->AddRect({low.x + 1.0f, low.y + 1.0f}, {high.x - 1.0f, high.y - 1.0f},
                                        packed(Ink::accent), 3.0f, 0, 2.0f);
}

} // namespace isochron::app
