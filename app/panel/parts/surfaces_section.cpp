// The panel's section on surfaces: their values, colors and opacities.
#include "app/panel/parts/surfaces_section.h"

#include "app/frame/step_survey.h"
#include "app/panel/panel_words.h"
#include "app/panel/parts/eye_memory.h"
#include "app/panel/parts/free_color.h"
#include "app/panel/parts/ghost_rows.h"
#include "app/panel/parts/histogram.h"
#include "app/panel/parts/icons.h"
#include "app/panel/parts/piece_lines.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/theme.h"
#include "app/text.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::Isosurface;

constexpr float kSmallIcon = 22.0f, kOpacityField = 54.0f;

/// A new surface of the picked one's array: with a color that no other has, and an isovalue of this
/// step's values, see `further_isovalue`, or else one between the picked one's and the farther end of
/// the range.
Isosurface another(const PanelModel& model) {
    const auto& surfaces = model.asked.isosurfaces;
    const Isosurface& like = surfaces[model.asked.picked];
    const double low = model.picked_stats().low, high = model.picked_stats().high,
                 picked = like.isovalue;
    const double end = high / 2 - picked / 2 > picked / 2 - low / 2 ? high : low;
    double isovalue = picked / 2 + end / 2;
    if (model.work.survey && like.of_shown_array()) {
        std::vector<double> there;
        for (const Isosurface& each : surfaces)
            if (each.of_shown_array())
                there.push_back(each.isovalue);
        isovalue = further_isovalue(*model.work.survey, there.front(), there).value_or(isovalue);
    }
    return {isovalue, free_color(surfaces), 1.0f, like.array};
}

/// What the user did with the list, beside what a row changes in its surface.
struct ListChange {
    std::optional<std::uint32_t> removed, picked;
    std::optional<double> isovalue; ///< new isovalue of `picked`
};

/// Hides a surface, and shows it again as opaque as it was.
void eye_button(std::uint32_t i, Isosurface& surface) {
    float& before = opacity_before(*ImGui::GetStateStorage(), "surface", i);
    const bool seen = surface.opacity > 0.0f;
    if (seen)
        before = surface.opacity;
    if (icon_button("eye", seen ? Icon::eye : Icon::eye_shut,
                    seen ? "hide this surface" : "show this surface", false, kSmallIcon))
        surface.opacity = seen ? 0.0f : before;
}

void menu_of_surface(const PanelModel& model, std::uint32_t i, ListChange& change) {
    if (icon_button("menu", Icon::menu, "more about this surface", false, kSmallIcon))
        ImGui::OpenPopup("surface");
    if (!ImGui::BeginPopup("surface"))
        return;
    popup_title("Surface");
    if (ImGui::MenuItem("move this one with keys and wheel", "I", model.asked.picked == i))
        change.picked = i;
    const auto& mark = model.asked.mark.point;
    const bool of_array = mark && mark->array == model.asked.isosurfaces[i].array;
    if (ImGui::MenuItem("isovalue: the value at the mark", nullptr, false, of_array)) {
        change.picked = i;
        change.isovalue = mark->value;
    }
    if (ImGui::MenuItem("remove", nullptr, false, model.asked.isosurfaces.size() > 1))
        change.removed = i;
    ImGui::EndPopup();
}

/// Adds a surface of another array beside those of the shown one.
/// @return number of the array
std::optional<std::size_t> array_button(const PanelModel& model) {
    std::optional<std::size_t> chosen;
    if (model.arrays.names.size() < 2)
        return chosen;
    ImGui::SameLine();
    if (icon_button("add of array", IconPath("O 8 12 5.5 O 16 12 5.5"),
                    "add a surface of another array to the picture", false, kSmallIcon))
        ImGui::OpenPopup("arrays");
    if (!ImGui::BeginPopup("arrays"))
        return chosen;
    popup_title("Surface of another array");
    for (std::size_t i = 0; i < model.arrays.names.size(); ++i)
        if (i != model.arrays.asked && ImGui::MenuItem(model.arrays.names[i].c_str()))
            chosen = i;
    ImGui::EndPopup();
    return chosen;
}

void surface_row(const PanelModel& model, std::uint32_t i, Isosurface& surface,
                 ListChange& change) {
    ImGui::PushID(static_cast<int>(i));
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    if (model.asked.picked == i && model.asked.isosurfaces.size() > 1)
        ImGui::GetWindowDrawList()->AddRectFilled({corner.x - 7.0f, corner.y},
                                                  {corner.x - 4.0f, corner.y + kSmallIcon},
                                                  packed(Ink::accent), 1.5f);
    ImGui::ColorEdit3("##color", &surface.color.x,
                      ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoTooltip);
    tip("its color");
    ImGui::SameLine();
    eye_button(i, surface);
    ImGui::SameLine();
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float width = ImGui::GetContentRegionAvail().x - kOpacityField - kSmallIcon - 2 * gap;
    ImGui::SetNextItemWidth(width);
    // Beyond half of the doubles' range ImGui gives up.
    constexpr double kMost = std::numeric_limits<double>::max() / 2;
    const index::SeriesInfo& info = model.info_of(i);
    const index::IndexStats& stats = model.stats_of(i);
    const bool own = model.arrays.of(i) != nullptr; // its array is not the shown one
    const std::string number = " " + with_unit(surface.isovalue, info.value_unit, info.digits);
    const float left = width - ImGui::CalcTextSize(number.c_str()).x - gap;
    double value = surface.isovalue;
    if (number_field("##isovalue", value,
                     {.low = std::clamp(stats.low, -kMost, kMost),
                      .high = std::clamp(stats.high, -kMost, kMost),
                      .bounded = false},
                     format_with(info.value_unit, own ? cut_to(info.array, left) : "", info.digits)
                         .c_str())) {
        change.picked = i;
        change.isovalue = value;
    }
    tip(fmt::format("isovalue{}: drag, or click and type (Up, Down)",
                    own ? " of " + info.array : "")
            .c_str());
    ImGui::SameLine();
    ImGui::SetNextItemWidth(kOpacityField);
    share_field("##opacity", surface.opacity);
    tip("opacity");
    ImGui::SameLine();
    menu_of_surface(model, i, change);
    ImGui::PopID();
}

/// What the user should know of the isovalues. It takes the rest of a line, so that the controls
/// below stay in place for the user's hand and for a replay.
void line_on_isovalues(const PanelModel& model) {
    const auto& surfaces = model.asked.isosurfaces;
    const double asked = model.asked.isovalue();
    const float width = ImGui::GetContentRegionAvail().x;
    const index::IndexStats& stats = model.picked_stats();
    if (asked < stats.low || asked > stats.high)
        return fitted_text(
            fmt::format("no surface: the data are {}",
                        range_text(stats.low, stats.high, model.picked_info().value_unit)),
            width, color_of(Ink::warning));
    if (std::ranges::count_if(surfaces, &Isosurface::of_shown_array) < 2)
        return text(" ");
    const bool through =
        std::ranges::any_of(surfaces, [](const Isosurface& each) { return each.opacity < 1.0f; });
    fitted_text(through ? "lower values lie outside" : "lower values hide others", width,
                color_of(Ink::dim));
}

void remove(std::uint32_t removed, std::vector<Isosurface>& surfaces, const ExplorerState& state,
            Commands& commands) {
    surfaces.erase(surfaces.begin() + removed);
    if (state.picked > removed || state.picked >= surfaces.size())
        commands.picked = state.picked - 1;
    if (auto pieces = without_surface(state.pieces, removed); pieces != state.pieces)
        commands.pieces = std::move(pieces);
}

void take(const ListChange& change, std::vector<Isosurface>& surfaces, const ExplorerState& state,
          Commands& commands) {
    if (change.picked && *change.picked != state.picked)
        commands.picked = change.picked;
    if (change.isovalue)
        commands.isovalue = change.isovalue;
    if (change.removed)
        remove(*change.removed, surfaces, state, commands);
}

} // namespace

void let_see(std::vector<Isosurface>& surfaces, std::size_t added) {
    for (Isosurface& outer : surfaces) {
        const bool encloses = std::ranges::any_of(surfaces, [&](const Isosurface& inner) {
            return inner.array == outer.array && inner.isovalue > outer.isovalue &&
                   (&outer == &surfaces[added] || &inner == &surfaces[added]);
        });
        if (encloses)
            outer.opacity = std::min(outer.opacity, kSeenThrough);
    }
}

Commands with_another(const PanelModel& model) {
    Commands commands;
    std::vector<Isosurface> surfaces = model.asked.isosurfaces;
    commands.picked = static_cast<std::uint32_t>(surfaces.size());
    surfaces.push_back(another(model));
    let_see(surfaces, surfaces.size() - 1);
    commands.isosurfaces = surfaces;
    return commands;
}

Commands with_surface_of(const PanelModel& model, std::size_t array) {
    Commands commands;
    const Commands first = model.arrays.way_to(array); // as it would be shown alone
    std::vector<Isosurface> surfaces = model.asked.isosurfaces;
    const auto its = first.isosurfaces.value_or(std::vector<Isosurface>{{}});
    const auto of_array = std::ranges::find_if(its, &Isosurface::of_shown_array);
    Isosurface added = of_array == its.end() ? its.front() : *of_array;
    added.color = free_color(surfaces);
    added.opacity = kSeenThrough;
    added.array = model.arrays.names[array];
    commands.picked = static_cast<std::uint32_t>(surfaces.size());
    surfaces.push_back(std::move(added));
    commands.isosurfaces = surfaces;
    return commands;
}

Commands without_surface(const PanelModel& model, std::uint32_t removed) {
    Commands commands;
    std::vector<Isosurface> surfaces = model.asked.isosurfaces;
    remove(removed, surfaces, model.asked, commands);
    commands.isosurfaces = surfaces;
    return commands;
}

void surfaces_section(const PanelModel& model, PanelPages& pages, Commands& commands) {
    histogram(model, commands);
    std::vector<Isosurface> surfaces = model.asked.isosurfaces;
    ListChange change;
    for (std::uint32_t i = 0; i < surfaces.size(); ++i)
        surface_row(model, i, surfaces[i], change);
    take(change, surfaces, model.asked, commands);
    ImGui::BeginDisabled(surfaces.size() >= interaction::kMostIsosurfaces);
    const bool adds = icon_button("add", Icon::add, "add another isosurface", false, kSmallIcon);
    const auto of_array = array_button(model);
    ImGui::EndDisabled();
    ghost_button(model, commands);
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    line_on_isovalues(model);
    if (surfaces != model.asked.isosurfaces)
        commands.isosurfaces = surfaces;
    ghost_rows(model, commands);
    if (adds)
        interaction::merge(commands, with_another(model));
    if (of_array)
        interaction::merge(commands, with_surface_of(model, *of_array));
    piece_lines(model, pages, commands);
}

} // namespace isochron::app
