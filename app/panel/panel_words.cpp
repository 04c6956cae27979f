// Lines of text in the panel, and tips on its controls.
#include "app/panel/panel_words.h"

#include "app/panel/parts/theme.h"

#include <imgui_internal.h>

#include <algorithm>
#include <string_view>

namespace isochron::app {

void text(const std::string& line) {
    ImGui::TextUnformatted(line.c_str());
}

namespace {

/// The lines of a text, and whether the last one is a single word.
struct Broken {
    int lines = 0;
    bool lone = false;
};
Broken broken(const std::string& words, float width) {
    const ImFont& font = *ImGui::GetFont();
    const float scale = ImGui::GetFontSize() / font.FontSize;
    Broken result;
    const char *at = words.data(), *const end = at + words.size();
    while (at < end) {
        const char* const stop = font.CalcWordWrapPositionA(scale, at, end, width);
        const std::string_view line(at, std::max(stop, at + 1));
        result = {result.lines + 1, line.find(' ') == std::string_view::npos};
        at = line.data() + line.size();
        while (at < end && *at == ' ')
            ++at;
    }
    return result;
}

} // namespace

float width_without_widow(const std::string& words, float width) {
    const Broken wide = broken(words, width);
    constexpr float kNarrowest = 0.75f, kFiner = 0.02f; // shares of the width
    if (wide.lines > 1 && wide.lone)
        for (float share = 1.0f - kFiner; share > kNarrowest; share -= kFiner) {
            const Broken narrow = broken(words, share * width);
            if (narrow.lines != wide.lines)
                break;
            if (!narrow.lone)
                return share * width;
        }
    return width;
}

void note(const std::string& line, const ImVec4& color) {
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() +
                           width_without_widow(line, ImGui::GetContentRegionAvail().x));
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
    ImGui::GetWindowDrawList()->AddRect({low.x + 1.0f, low.y + 1.0f},
                                        {high.x - 1.0f, high.y - 1.0f}, packed(Ink::accent), 3.0f,
                                        0, 2.0f);
}

} // namespace isochron::app
