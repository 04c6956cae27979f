// The mark in words, and keeping it.
#include "app/panel/parts/mark_lines.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/icons.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/theme.h"
#include "app/panel/parts/time_track.h"
#include "app/scene/mark.h"
#include "interaction/next_number.h"

#include <imgui.h>

#include <algorithm>
#include <string>
#include <utility>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::NamedMark;

constexpr const char* const kOverTime = "over time";
constexpr const char* const kKeep = "keep";

/// The place that the user picked, as much of it as there is room for.
void mark_words(const PanelModel& model, float width, Commands& commands) {
    const interaction::MarkedPoint& point = *model.asked.mark.point;
    constexpr const char* kHere = "isovalue here";
    const ImGuiStyle& style = ImGui::GetStyle();
    const float buttons = ImGui::CalcTextSize(kHere).x + 2 * style.FramePadding.x +
                          ImGui::GetFrameHeight() + 4 * style.ItemSpacing.x +
                          button_width(kOverTime) + button_width(kKeep);
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

} // namespace

bool has_loose_mark(const interaction::Settings& settings) {
    const auto& mark = settings.mark.point;
    return mark && std::ranges::none_of(settings.marks, [&](const NamedMark& each) {
               return each.point.position == mark->position;
           });
}

std::vector<NamedMark> with_mark(std::vector<NamedMark> marks, interaction::MarkedPoint point,
                                 const index::SeriesInfo& info) {
    if (point.array.empty()) {
        point.array = info.array;
        point.unit = info.value_unit;
    }
    marks.push_back({interaction::next_number(marks), std::move(point)});
    return marks;
}

Commands way_to_mark(const PanelModel& model, const interaction::MarkedPoint& point) {
    Commands commands;
    commands.mark = interaction::Mark{point};
    show(point.instant.within(model.info.steps()), commands);
    commands.playback = model.asked.playback;
    commands.playback->playing = false;
    return commands;
}

void mark_lines(const PanelModel& model, float width, Commands& commands) {
    const float right = ImGui::GetCursorScreenPos().x + width;
    mark_words(model, width, commands);
    const interaction::CurveDrawer& curves = model.asked.curves;
    go_on_within(right, button_width(kOverTime));
    if (ImGui::Button(kOverTime)) {
        const bool there = curves.shown && curves.measure == kMarkCurve;
        commands.curves = curves;
        commands.curves->shown = !there;
        commands.curves->measure = kMarkCurve;
    }
    tip("the value at the mark as a curve, and how far the surfaces are from it at each step");
    if (!has_loose_mark(model.asked) || model.asked.marks.size() >= interaction::kMostMarks)
        return;
    go_on_within(right, button_width(kKeep));
    if (ImGui::Button(kKeep))
        commands.marks = with_mark(model.asked.marks, *model.asked.mark.point, model.info);
    tip("keep this mark, with a name, beside the next ones: in the list of objects");
}

} // namespace isochron::app
