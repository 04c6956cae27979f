// The ghosts in numbers.
#include "app/panel/parts/ghost_rows.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/icons.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/theme.h"
#include "interaction/controls/action_table.h"

#include <imgui.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

namespace isochron::app {
namespace {

/// A field for a count, one of two that share a row.
void count_field(const char* id, std::uint32_t& count, std::uint32_t low, std::uint32_t high,
                 const char* format) {
    int number = static_cast<int>(count);
    if (whole_number_field(id, &number, static_cast<int>(low), static_cast<int>(high), format))
        count = static_cast<std::uint32_t>(number);
}

/// Begins a row of two fields. @return width of each
float row_of_two(const char* label) {
    row(label);
    return (ImGui::CalcItemWidth() - ImGui::GetStyle().ItemSpacing.x) / 2;
}

} // namespace

void ghost_button(const PanelModel& model, interaction::Commands& commands) {
    constexpr float kSide = 22.0f;
    if (model.info.steps() < 2)
        return;
    ImGui::SameLine();
    if (icon_button("ghosts", IconPath(kGhostIcon),
                    "ghosts: surfaces of earlier and later steps (Ctrl + Shift + G)",
                    model.asked.ghosts.shown(), kSide))
        commands.ghosts = interaction::ghosts_on_or_off(model.asked.ghosts);
}

void ghost_rows(const PanelModel& model, interaction::Commands& commands) {
    interaction::Ghosts ghosts = model.asked.ghosts;
    if (ghosts.earlier + ghosts.later == 0)
        return;
    const auto steps = static_cast<std::uint32_t>(std::max<std::size_t>(model.info.steps(), 2));
    ImGui::PushID("ghosts");
    const float width = row_of_two("ghosts");
    ImGui::SetNextItemWidth(width);
    count_field("##earlier", ghosts.earlier, 0, interaction::kMostGhosts, "%d earlier");
    tip("surfaces of so many earlier steps, translucent and bluer");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(width);
    count_field("##later", ghosts.later, 0, interaction::kMostGhosts, "%d later");
    tip("surfaces of so many later steps, translucent and warmer");
    row_of_two("");
    ImGui::SetNextItemWidth(width);
    count_field("##every", ghosts.every, 1,
                std::min(interaction::kWidestGhosts, std::max(ghosts.every, steps - 1)),
                ghosts.every == 1 ? "each step" : "every %d");
    tip("how many steps it is from one ghost to the next");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(width);
    share_field("##opacity", ghosts.opacity);
    tip("opacity of the ghosts");
    // In the room all walls say the same, whatever has been made.
    const std::string& words =
        model.place == PanelPlace::in_room ? model.ghosts.wished : model.ghosts.shown;
    fitted_text(!ghosts.shown() ? "no ghosts: their opacity is 0"
                : words.empty() ? "no ghosts: the series has no such steps"
                                : words,
                ImGui::GetContentRegionAvail().x, color_of(Ink::dim));
    ImGui::PopID();
    if (ghosts != model.asked.ghosts)
        commands.ghosts = ghosts;
}

} // namespace isochron::app
