// A list of things with names: the user goes to one, renames one, removes one.
#include "app/panel/parts/named_list.h"

#include "app/panel/imgui/number_entry.h"
#include "app/panel/panel_words.h"
#include "app/panel/parts/icons.h"
#include "app/panel/parts/theme.h"

#include <algorithm>

namespace isochron::app {

NamedChange named_list(std::span<const NamedRow> rows, const char* go,
                       const std::function<void(std::size_t row, const ImVec2& middle)>& draw) {
    constexpr float kIcon = 24.0f, kName = 150.0f, kMostRows = 9.0f;
    NamedChange change;
    float notes = 0.0f;
    for (const NamedRow& each : rows)
        notes = std::max(notes, ImGui::CalcTextSize(each.note.c_str()).x);
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float picture = draw ? kIcon + gap : 0.0f;
    const float width = picture + 2 * (kIcon + gap) + kName + gap + notes + 14.0f;
    const float line = kIcon + ImGui::GetStyle().ItemSpacing.y;
    const float height = line * std::min(kMostRows, static_cast<float>(rows.size()));
    ImGui::BeginChild("list", {width, height});
    for (std::size_t i = 0; i < rows.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        if (draw) {
            const ImVec2 corner = ImGui::GetCursorScreenPos();
            draw(i, {corner.x + kIcon / 2, corner.y + kIcon / 2});
            ImGui::Dummy({kIcon, kIcon});
            ImGui::SameLine();
        }
        if (icon_button("go", Icon::go, go, rows[i].here, kIcon))
            change.chosen = i;
        ImGui::SameLine();
        ImGui::SetNextItemWidth(kName);
        std::string name = rows[i].name;
        if (finished_text("##name", "name", name) && !name.empty() && name != rows[i].name)
            change.renamed = {i, name};
        ImGui::SameLine();
        ImGui::AlignTextToFramePadding();
        ImGui::TextColored(color_of(Ink::dim), "%s", rows[i].note.c_str());
        ImGui::SameLine(width - kIcon - 10.0f);
        if (icon_button("remove", Icon::remove, "remove it from the list", false, kIcon))
            change.removed = i;
        ImGui::PopID();
    }
    ImGui::EndChild();
    return change;
}

} // namespace isochron::app
