// The panel's sections on surfaces and on coloring.
#include "app/panel/panel_colors.h"

#include "app/panel/panel_words.h"
#include "app/text.h"
#include "render/passes/color_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::Isosurface;

/// A new surface: with a color that no other has, and an isovalue between the picked one's and the
/// farther end of the range.
Isosurface another(const PanelModel& model) {
    const auto& surfaces = model.asked.isosurfaces;
    const auto& palette = render::surface_palette();
    const auto free = std::ranges::find_if(palette, [&](const glm::vec3& color) {
        return std::ranges::find(surfaces, color, &Isosurface::color) == surfaces.end();
    });
    const double low = model.stats.low, high = model.stats.high, picked = model.asked.isovalue();
    const double end = high / 2 - picked / 2 > picked / 2 - low / 2 ? high : low;
    return {picked / 2 + end / 2, free == palette.end() ? palette.front() : *free, 1.0f};
}

/// One line of the list. @return true: remove this surface
bool surface_line(const PanelModel& model, std::uint32_t i, std::vector<Isosurface>& surfaces,
                  Commands& commands) {
    Isosurface& surface = surfaces[i];
    ImGui::PushID(static_cast<int>(i));
    const std::string value = with_unit(surface.isovalue, model.info.value_unit);
    if (ImGui::RadioButton("##pick", model.asked.picked == i))
        commands.picked = i;
    tip("the isovalue moves this surface (I)");
    ImGui::SameLine();
    ImGui::ColorEdit3("##color", &surface.color.x, ImGuiColorEditFlags_NoInputs);
    tip("its color");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(90.0f);
    ImGui::SliderFloat("##opacity", &surface.opacity, 0.0f, 1.0f, "%.2f",
                       ImGuiSliderFlags_AlwaysClamp);
    tip("its opacity: 0 is invisible");
    ImGui::SameLine();
    ImGui::TextUnformatted(value.c_str());
    bool removed = false;
    if (surfaces.size() > 1) {
        ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - 22.0f);
        removed = ImGui::SmallButton("x");
        tip("remove this surface");
    }
    ImGui::PopID();
    return removed;
}

void range_of_map(const PanelModel& model, interaction::Coloring& coloring) {
    bool automatic = !coloring.range;
    if (ImGui::Checkbox("all values", &automatic)) {
        coloring.range.reset();
        if (!automatic)
            coloring.range = model.whole_range;
    }
    tip("the colors span all values; off: a range of your own");
    if (!coloring.range)
        return;
    std::array<double, 2> range = *coloring.range;
    ImGui::SetNextItemWidth(-60.0f);
    if (ImGui::InputScalarN("range", ImGuiDataType_Double, range.data(), 2, nullptr, nullptr,
                            "%.6g") &&
        range[0] < range[1])
        coloring.range = range;
    tip("values at the two ends of the colors");
}

} // namespace

void surfaces_section(const PanelModel& model, Commands& commands) {
    std::vector<Isosurface> surfaces = model.asked.isosurfaces;
    std::optional<std::uint32_t> removed;
    for (std::uint32_t i = 0; i < surfaces.size(); ++i)
        if (surface_line(model, i, surfaces, commands))
            removed = i;
    if (removed) {
        surfaces.erase(surfaces.begin() + *removed);
        if (model.asked.picked > *removed)
            commands.picked = model.asked.picked - 1;
    }
    const bool more = surfaces.size() < interaction::kMostIsosurfaces;
    const bool added = more && ImGui::SmallButton("add a surface");
    if (more)
        tip("one more isovalue beside these; all become half transparent");
    if (added) {
        commands.picked = static_cast<std::uint32_t>(surfaces.size());
        // Make all surfaces translucent, so that the new one shows even inside others.
        constexpr float kSeenThrough = 0.45f;
        for (Isosurface& surface : surfaces)
            surface.opacity = std::min(surface.opacity, kSeenThrough);
        surfaces.push_back(another(model));
    }
    if (surfaces != model.asked.isosurfaces)
        commands.isosurfaces = surfaces;
}

void coloring_section(const PanelModel& model, Commands& commands) {
    interaction::Coloring coloring = model.asked.coloring;
    const auto choice = [](const char* label, const std::string& current, auto&& names,
                           const char* effect, auto&& choose) {
        ImGui::SetNextItemWidth(-60.0f);
        if (!ImGui::BeginCombo(label, current.c_str())) {
            tip(effect);
            return;
        }
        for (std::size_t i = 0; i < names.size(); ++i)
            if (ImGui::Selectable(std::string(names[i]).c_str(), names[i] == current))
                choose(i);
        ImGui::EndCombo();
    };
    constexpr std::array<std::string_view, 3> kWords{"which surface", "second array",
                                                     "first crossing"};
    choice("color", std::string(kWords[static_cast<std::size_t>(coloring.by)]), kWords,
           "what the colors of surfaces say (U)", [&](std::size_t i) {
               const auto by = static_cast<interaction::ColorBy>(i);
               if (by == interaction::ColorBy::value && !model.second_array)
                   return;
               if (by != coloring.by)
                   coloring.range.reset();
               coloring.by = by;
           });
    if (coloring.by != interaction::ColorBy::surface) {
        choice("map", coloring.map, render::kColorMapNames, "colors from the low to the high end",
               [&](std::size_t i) { coloring.map = render::kColorMapNames[i]; });
        range_of_map(model, coloring);
    }
    if (coloring != model.asked.coloring)
        commands.coloring = coloring;
    bool shown = model.asked.bounding_box;
    if (ImGui::Checkbox("box with numbers", &shown))
        commands.bounding_box = shown;
    tip("the data's box, with ticks in their units (O)");
}

} // namespace isochron::app
