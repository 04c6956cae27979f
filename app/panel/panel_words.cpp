// Lines of text in the panel, and what is said of its controls.
#include "app/panel/panel_words.h"

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

void state_note(const std::string& line, const ImVec4& color) {
    ImGui::TextColored(color, "%s", line.c_str());
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s", line.c_str());
}

void tip(const char* words) {
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
        ImGui::SetTooltip("%s", words);
}

} // namespace isochron::app
