// Rows of the panel's sections: the label in a column at the left, the control beside it.
#include "app/panel/parts/rows.h"

#include "app/panel/imgui/keyed_list.h"
#include "app/panel/panel_words.h"
#include "app/panel/parts/room_keys.h"
#include "app/panel/parts/theme.h"
#include "app/text.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

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

/// The number that a hand without a keyboard has typed for a field. @return whether there is one
bool keyed(ImGuiID id, ImGuiDataType type, void* value, const FieldRange& range) {
    if (RoomKeys::here() == nullptr)
        return false;
    const bool whole = type == ImGuiDataType_S32;
    const double now = whole ? static_cast<double>(*static_cast<int*>(value))
                       : type == ImGuiDataType_Double
                           ? *static_cast<double*>(value)
                           : static_cast<double>(*static_cast<float*>(value));
    const auto typed = keyed_text(id, whole ? RoomKeys::Kind::whole_number : RoomKeys::Kind::number,
                                  human_number(now));
    if (!typed)
        return false;
    double number = 0;
    const char* const end = typed->data() + typed->size();
    const auto read = std::from_chars(typed->data(), end, number);
    if (read.ec != std::errc() || read.ptr != end || !std::isfinite(number))
        return false;
    if (range.bounded)
        number = std::clamp(number, range.low, range.high);
    if (whole)
        *static_cast<int*>(value) = static_cast<int>(number);
    else if (type == ImGuiDataType_Double)
        *static_cast<double*>(value) = number;
    else
        *static_cast<float*>(value) = static_cast<float>(number);
    return true;
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
    return keyed(ImGui::GetID(id), type, value, range) || changed;
}

} // namespace

void row(const char* label, float spared) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(color_of(Ink::dim), "%s", label);
    const float left = ImGui::GetStyle().WindowPadding.x;
    ImGui::SameLine(left + kLabelColumn);
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - spared);
}

std::string cut_to(const std::string& words, float width) {
    std::string shown = words;
    const auto wide = [&] { return ImGui::CalcTextSize(shown.c_str()).x > width; };
    for (std::size_t kept = words.size(); wide() && kept > 1;) {
        do // whole characters
            --kept;
        while (kept > 0 && (static_cast<unsigned char>(words[kept]) & 0xc0) == 0x80);
        shown = words.substr(0, kept) + "...";
    }
    return shown;
}

void fitted_text(const std::string& words, float width, const ImVec4& color) {
    const std::string shown = cut_to(words, width);
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

bool share_field(const char* id, float& share) {
    float percent = 100.0f * share;
    const bool changed = number_field(id, percent, {.low = 0, .high = 100}, "%.0f %%");
    if (changed)
        share = percent / 100.0f;
    return changed;
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
                                        std::span<const std::string> words, const char* effect,
                                        std::span<const std::string> notes) {
    if (!ImGui::BeginCombo(id, current.c_str())) {
        tip(effect);
        return std::nullopt;
    }
    std::optional<std::size_t> chosen;
    float widest = 0.0f;
    for (const std::string& each : words)
        widest = std::max(widest, ImGui::CalcTextSize(each.c_str()).x);
    const auto here = std::ranges::find(words, current) - words.begin();
    const KeyedList keys(static_cast<std::size_t>(here), words.size());
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (keys.line(i, ImGui::Selectable(words[i].c_str(), keys.at(i))))
            chosen = i;
        if (i >= notes.size())
            continue;
        ImGui::SameLine(widest + 3 * ImGui::GetStyle().WindowPadding.x);
        ImGui::TextColored(color_of(Ink::dim), "%s", notes[i].c_str());
    }
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

void go_on_within(float right, float width, float gap) {
    const float apart = gap < 0 ? ImGui::GetStyle().ItemSpacing.x : gap;
    if (ImGui::GetItemRectMax().x + apart + width <= right)
        ImGui::SameLine(0.0f, apart);
}

float button_width(const char* words) {
    return ImGui::CalcTextSize(words).x + 2 * ImGui::GetStyle().FramePadding.x;
}

float tick_width(const char* words) {
    return ImGui::GetFrameHeight() + ImGui::GetStyle().ItemSpacing.x + ImGui::CalcTextSize(words).x;
}

LinePress table_line(bool chosen, float height) {
    ImGui::Selectable("##line", chosen, height > 0 ? 0 : ImGuiSelectableFlags_SpanAllColumns,
                      {0.0f, height});
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem) ||
        !ImGui::IsMouseClicked(ImGuiMouseButton_Left))
        return LinePress::none;
    const bool even = ImGui::GetMouseClickedCount(ImGuiMouseButton_Left) % 2 == 0;
    return even ? LinePress::twice : LinePress::once;
}

std::string format_with(const std::string& unit, const std::string& words, int digits) {
    std::string format;
    const auto add = [&](const std::string& text) {
        for (const char c : text)
            format += c == '%' ? "%%" : std::string(1, c);
    };
    add(words);
    format += fmt::format("{}%.{}g", format.empty() ? "" : " ", digits);
    if (!unit.empty())
        add(" " + unit);
    return format;
}

} // namespace isochron::app
