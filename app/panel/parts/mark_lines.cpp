// The mark, and the list of marks that were kept.
#include "app/panel/parts/mark_lines.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/icons.h"
#include "app/panel/parts/named_list.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/theme.h"
#include "app/panel/parts/time_track.h"
#include "app/scene/mark.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::NamedMark;

/// The place that the user picked, as much of it as there is room for.
void mark_words(const PanelModel& model, float width, Commands& commands) {
    const interaction::MarkedPoint& point = *model.asked.mark.point;
    constexpr const char* kHere = "isovalue here";
    constexpr float kFurther = 130.0f; // the buttons of kept marks
    const ImGuiStyle& style = ImGui::GetStyle();
    const float buttons = ImGui::CalcTextSize(kHere).x + 2 * style.FramePadding.x +
                          ImGui::GetFrameHeight() + 2 * style.ItemSpacing.x + kFurther;
    const auto fits = [&](const std::string& words) {
        return ImGui::CalcTextSize(words.c_str()).x + buttons <= width;
    };
    ImGui::AlignTextToFramePadding();
    const std::string all = mark_text(point, model.info),
                      words = mark_text(point, model.info, fits);
    text(words);
    if (words != all)
        tip(all.c_str());
    if (model.asked.is_of_picked(point)) {
        ImGui::SameLine();
        if (ImGui::Button(kHere))
            commands.isovalue = point.value;
        tip("set the isovalue to the value at the mark");
    }
    ImGui::SameLine();
    if (icon_button("no mark", Icon::remove, "remove the mark (Delete)", false,
                    ImGui::GetFrameHeight()))
        commands.mark = interaction::Mark{};
}

/// The marks with the mark under the next free name, and the array whose value it is.
std::vector<NamedMark> with_mark(std::vector<NamedMark> marks, interaction::MarkedPoint point,
                                 const index::SeriesInfo& info) {
    if (point.array.empty()) {
        point.array = info.array;
        point.unit = info.value_unit;
    }
    const auto taken = [&](const std::string& name) {
        return std::ranges::find(marks, name, &NamedMark::name) != marks.end();
    };
    std::size_t number = 1;
    while (taken(fmt::format("{}", number)))
        ++number;
    marks.push_back({fmt::format("{}", number), std::move(point)});
    return marks;
}

void list_of_marks(const PanelModel& model, Commands& commands) {
    if (!ImGui::BeginPopup("marks"))
        return;
    popup_title("Marks");
    std::vector<NamedMark> marks = model.asked.marks;
    const auto& here = model.asked.mark.point;
    std::vector<NamedRow> rows;
    for (const NamedMark& mark : marks)
        rows.push_back({mark.name, mark_text(mark.point, model.info),
                        here && here->position == mark.point.position});
    const NamedChange change = named_list(rows, "go to the time of this mark, and point it out");
    if (change.chosen) {
        commands.mark = interaction::Mark{marks[*change.chosen].point};
        show(marks[*change.chosen].point.instant.within(model.info.steps()), commands);
        commands.playback = model.asked.playback;
        commands.playback->playing = false;
    }
    if (change.renamed)
        marks[change.renamed->first].name = change.renamed->second;
    if (change.removed)
        marks.erase(marks.begin() + static_cast<std::ptrdiff_t>(*change.removed));
    if (change.renamed || change.removed)
        commands.marks = marks;
    ImGui::EndPopup();
}

} // namespace

bool has_marks(const PanelModel& model) {
    return model.asked.mark.point || !model.asked.marks.empty();
}

void mark_lines(const PanelModel& model, float width, Commands& commands) {
    const auto& mark = model.asked.mark.point;
    const std::vector<NamedMark>& marks = model.asked.marks;
    if (mark) {
        mark_words(model, width, commands);
        const bool known = std::ranges::any_of(
            marks, [&](const NamedMark& each) { return each.point.position == mark->position; });
        if (!known && marks.size() < interaction::kMostMarks) {
            ImGui::SameLine();
            if (ImGui::Button("keep"))
                commands.marks = with_mark(marks, *mark, model.info);
            tip("keep this mark, with a name, beside the next ones");
        }
        if (!marks.empty())
            ImGui::SameLine();
    }
    if (!marks.empty()) {
        if (ImGui::Button(fmt::format("marks ({})##marks", marks.size()).c_str()))
            ImGui::OpenPopup("marks");
        tip("the marks that were kept: go to one, rename it, remove it");
    }
    list_of_marks(model, commands);
}

} // namespace isochron::app
