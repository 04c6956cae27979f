// Rows of the panel's sections: the label in a column at the left, the control beside it.
#include "app/panel/parts/rows.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/theme.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

namespace isochron::app {
namespace {

/// Where a value lies in a range, 0 to 1.
float share_of(double value, const FieldRange& range) {
    double low = range.low, high = range.high;
    if (range.logarithmic) {
        value = std::log(std::max(value, low));
        low = std::log(low);
        high = std::log(high);
    }
    const double half_span = high / 2 - low / 2; // halves keep it finite for any two doubles
    if (!(half_span > 0))
        return 0.0f;
    return static_cast<float>(std::clamp((value / 2 - low / 2) / half_span, 0.0, 1.0));
}

/// The field below the number: its paper, and the filled part.
void paper_of_field(const char* id, float share, float width) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 end(corner.x + width, corner.y + ImGui::GetFrameHeight());
    const ImGuiID number = ImGui::GetID(id);
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    const ImGuiCol_ paper = context.ActiveId == number    ? ImGuiCol_FrameBgActive
                            : context.HoveredId == number ? ImGuiCol_FrameBgHovered
                                                          : ImGuiCol_FrameBg;
    const float rounding = ImGui::GetStyle().FrameRounding;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(corner, end, ImGui::GetColorU32(paper), rounding);
    if (share > 0.0f && !ImGui::TempInputIsActive(number))
        list.AddRectFilled(corner, {corner.x + std::max(share * width, 2 * rounding), end.y},
                           ImGui::GetColorU32(color_of(Ink::chosen)), rounding);
}

bool field(const char* id, ImGuiDataType type, void* value, double shown, const FieldRange& range,
           const void* low, const void* high, const char* format) {
    const float width = ImGui::CalcItemWidth();
    ImGui::SetNextItemWidth(width);
    paper_of_field(id, share_of(shown, range), width);
    for (const ImGuiCol_ each : {ImGuiCol_FrameBg, ImGuiCol_FrameBgHovered, ImGuiCol_FrameBgActive})
        ImGui::PushStyleColor(each, ImVec4(0, 0, 0, 0));
    ImGuiSliderFlags flags = range.bounded ? ImGuiSliderFlags_AlwaysClamp : 0;
    if (range.logarithmic)
        flags |= ImGuiSliderFlags_Logarithmic;
    // The value keeps up with the hand across the field, as far as a float holds the range.
    const auto speed = static_cast<float>(
        std::clamp((range.high / 2 - range.low / 2) / static_cast<double>(width) * 2, 0.0, 1e37));
    const bool changed = ImGui::DragScalar(id, type, value, speed, low, high, format, flags);
    ImGui::PopStyleColor(3);
    return changed;
}

} // namespace

void row(const char* label, float spared) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(color_of(Ink::dim), "%s", label);
    const float left = ImGui::GetStyle().WindowPadding.x;
    ImGui::SameLine(left + kLabelColumn);
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - spared);
}

void fitted_text(const std::string& words, float width, const ImVec4& color) {
    std::string shown = words;
    const auto wide = [&] { return ImGui::CalcTextSize(shown.c_str()).x > width; };
    for (std::size_t kept = words.size(); wide() && kept > 1;) {
        do // whole characters
            --kept;
        while (kept > 0 && (static_cast<unsigned char>(words[kept]) & 0xc0) == 0x80);
        shown = words.substr(0, kept) + "...";
    }
    ImGui::TextColored(color, "%s", shown.c_str());
    if (shown != words)
        tip(words.c_str());
}

void text_row(const char* label, const std::string& words) {
    row(label);
    fitted_text(words, ImGui::CalcItemWidth(), color_of(Ink::text));
}

bool number_field(const char* id, double& value, const FieldRange& range, const char* format) {
    return field(id, ImGuiDataType_Double, &value, value, range, &range.low, &range.high, format);
}

bool number_field(const char* id, float& value, const FieldRange& range, const char* format) {
    const auto low = static_cast<float>(range.low), high = static_cast<float>(range.high);
    return field(id, ImGuiDataType_Float, &value, static_cast<double>(value), range, &low, &high,
                 format);
}

bool whole_number_field(const char* id, int* value, int low, int high, const char* format) {
    const ImGuiID number = ImGui::GetID(id);
    if (ImGui::GetCurrentContext()->ActiveId != number)
        ImGui::GetStateStorage()->SetInt(number, *value); // for NumberEntry
    return field(id, ImGuiDataType_S32, value, static_cast<double>(*value),
                 {.low = static_cast<double>(low), .high = static_cast<double>(high)}, &low, &high,
                 format);
}

std::optional<std::size_t> choice_field(const char* id, const std::string& current,
                                        std::span<const std::string> words, const char* effect) {
    if (!ImGui::BeginCombo(id, current.c_str())) {
        tip(effect);
        return std::nullopt;
    }
    std::optional<std::size_t> chosen;
    for (std::size_t i = 0; i < words.size(); ++i)
        if (ImGui::Selectable(words[i].c_str(), words[i] == current))
            chosen = i;
    ImGui::EndCombo();
    return chosen;
}

bool tick_field(const char* id, bool& on, const char* words) {
    const bool changed = ImGui::Checkbox(id, &on);
    if (*words == '\0')
        return changed;
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(words);
    return changed;
}

std::string format_with(const std::string& unit) {
    std::string format = unit.empty() ? "%.6g" : "%.6g ";
    for (char c : unit)
        format += c == '%' ? "%%" : std::string(1, c);
    return format;
}

} // namespace isochron::app
