// The panel's sections on surfaces and on coloring.
#include "app/panel/panel_colors.h"

#include "app/panel/number_entry.h"
#include "app/panel/panel_words.h"
#include "app/scene/color_scale.h"
#include "app/text.h"
#include "render/passes/color_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <type_traits>

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
    tip("opacity: 0 is invisible");
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

} // namespace

void let_see(std::vector<Isosurface>& surfaces, std::size_t added) {
    constexpr float kSeenThrough = 0.45f;
    for (Isosurface& outer : surfaces) {
        const bool encloses = std::ranges::any_of(surfaces, [&](const Isosurface& inner) {
            return inner.isovalue > outer.isovalue &&
                   (&outer == &surfaces[added] || &inner == &surfaces[added]);
        });
        if (encloses)
            outer.opacity = std::min(outer.opacity, kSeenThrough);
    }
}

namespace {

void text_of_rule(const std::vector<Isosurface>& surfaces) {
    const bool through = std::ranges::any_of(
        surfaces, [](const Isosurface& surface) { return surface.opacity < 1.0f; });
    note(through
             ? "surfaces of lower isovalues lie outside and are made translucent, to show the "
               "inner ones"
             : "surfaces of lower isovalues lie outside: lower their opacity to see the inner ones",
         kDim);
}

/// How the map is used.
void way_of_map(interaction::Coloring& coloring) {
    ImGui::Checkbox("reversed", &coloring.reversed);
    tip("reverse the color map");
    ImGui::SameLine();
    ImGui::Checkbox("logarithmic", &coloring.logarithmic);
    tip("logarithmic scale, for values above 0");
    int bands = static_cast<int>(coloring.bands);
    ImGui::SetNextItemWidth(-60.0f);
    if (whole_number_slider("bands", &bands, 0, 20, bands == 0 ? "none" : "%d"))
        coloring.bands = static_cast<std::uint32_t>(bands);
    tip("number of discrete colors; 0: continuous");
}

void range_of_map(const PanelModel& model, interaction::Coloring& coloring) {
    bool automatic = !coloring.range;
    if (ImGui::Checkbox("automatic range", &automatic)) {
        coloring.range.reset();
        if (!automatic)
            coloring.range = model.colors.range;
    }
    tip("the range is found from the values; off: set it yourself");
    if (automatic) {
        bool percentiles = coloring.percentiles.has_value();
        ImGui::SameLine();
        if (ImGui::Checkbox("percentiles", &percentiles)) {
            coloring.percentiles.reset();
            if (percentiles)
                coloring.percentiles = {2.0, 98.0};
        }
        tip("between two percentiles of the values on the shown surfaces; off: all values");
    }
    if (automatic && coloring.percentiles) {
        std::array<double, 2> ends = *coloring.percentiles;
        ImGui::SetNextItemWidth(-60.0f);
        if (ImGui::InputScalarN("%", ImGuiDataType_Double, ends.data(), 2, nullptr, nullptr, "%.4g",
                                ImGuiInputTextFlags_CharsScientific) &&
            0 <= ends[0] && ends[0] < ends[1] && ends[1] <= 100)
            coloring.percentiles = ends;
        tip("lowest and highest percentile, 0 to 100");
    }
    if (!coloring.range)
        return;
    std::array<double, 2> range = *coloring.range;
    ImGui::SetNextItemWidth(-60.0f);
    if (ImGui::InputScalarN("range", ImGuiDataType_Double, range.data(), 2, nullptr, nullptr,
                            "%.6g", ImGuiInputTextFlags_CharsScientific) &&
        range[0] < range[1])
        coloring.range = range;
    tip("lowest and highest value of the range");
}

} // namespace

void array_section(const PanelModel& model, Commands& commands) {
    if (model.arrays.names.size() < 2)
        return;
    ImGui::SetNextItemWidth(-60.0f);
    if (ImGui::BeginCombo("array", model.arrays.names[model.arrays.asked].c_str())) {
        for (std::size_t i = 0; i < model.arrays.names.size(); ++i)
            if (ImGui::Selectable(model.arrays.names[i].c_str(), i == model.arrays.asked) &&
                i != model.arrays.asked)
                interaction::merge(commands, model.arrays.way_to(i));
        ImGui::EndCombo();
    }
    tip("array whose isosurfaces are shown (Ctrl + A)");
}

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
        tip("add another isosurface");
    if (added) {
        commands.picked = static_cast<std::uint32_t>(surfaces.size());
        surfaces.push_back(another(model));
        let_see(surfaces, surfaces.size() - 1);
    }
    if (surfaces.size() > 1)
        text_of_rule(surfaces);
    if (surfaces != model.asked.isosurfaces)
        commands.isosurfaces = surfaces;
}

void look_section(const PanelModel& model, Commands& commands) {
    interaction::Look look = model.asked.look;
    const auto choice = [](const char* label, auto& value, const char* effect) {
        using Value = std::remove_reference_t<decltype(value)>;
        ImGui::SetNextItemWidth(0.28f * ImGui::GetWindowContentRegionMax().x);
        if (ImGui::BeginCombo(label, std::string(interaction::name_of(value)).c_str())) {
            for (std::size_t i = 0; i < interaction::kNames<Value>.size(); ++i) {
                const auto one = static_cast<Value>(i);
                if (ImGui::Selectable(std::string(interaction::name_of(one)).c_str(), one == value))
                    value = one;
            }
            ImGui::EndCombo();
        }
        tip(effect);
    };
    choice("material", look.material, "how surfaces shine");
    ImGui::SameLine();
    choice("background", look.background, "what is behind the data");
    ImGui::SetNextItemWidth(-60.0f);
    ImGui::SliderFloat("occlusion", &look.occlusion, 0.0f, 1.0f, "%.2f",
                       ImGuiSliderFlags_AlwaysClamp);
    tip("ambient occlusion: how dark crevices are");
    if (look != model.asked.look)
        commands.look = look;
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
    const bool several = model.arrays.color_names.size() > 1;
    const std::array<std::string_view, 3> words{
        "which surface", several ? "an array" : "second array", "first crossing"};
    choice("color", std::string(words[static_cast<std::size_t>(coloring.by)]), words,
           "what surfaces are colored by (U)", [&](std::size_t i) {
               const auto by = static_cast<interaction::ColorBy>(i);
               if (by == interaction::ColorBy::value && model.arrays.color_names.empty())
                   return;
               if (by != coloring.by)
                   coloring.range.reset();
               coloring.by = by;
           });
    if (coloring.by == interaction::ColorBy::value && several)
        choice("by", model.arrays.color_names[model.arrays.color], model.arrays.color_names,
               "array to color by (Ctrl + U)", [&](std::size_t i) {
                   if (i != model.arrays.color)
                       coloring.range.reset();
                   coloring.array = model.arrays.color_names[i];
               });
    if (coloring.by != interaction::ColorBy::surface) {
        std::vector<std::string> names{render::kColorMapNames.begin(),
                                       render::kColorMapNames.end()};
        const std::size_t own = names.size();
        for (const LoadedColorMap& map : model.colors.own_maps)
            names.push_back(map.name);
        std::vector<std::string> shown_names = names;
        for (std::size_t i = 0; i < own; ++i)
            shown_names[i] = render::shown_name_of(static_cast<render::ColorMap>(i));
        const auto now = std::ranges::find(names, coloring.map);
        choice("map",
               now == names.end() ? coloring.map
                                  : shown_names[static_cast<std::size_t>(now - names.begin())],
               shown_names, "color map, from the lowest to the highest value", [&](std::size_t i) {
                   coloring.map = names[i];
                   coloring.colors = i < own ? std::vector<std::uint32_t>()
                                             : model.colors.own_maps[i - own].colors;
               });
        way_of_map(coloring);
        range_of_map(model, coloring);
    }
    if (coloring != model.asked.coloring)
        commands.coloring = coloring;
    bool shown = model.asked.bounding_box;
    if (ImGui::Checkbox("box with numbers", &shown))
        commands.bounding_box = shown;
    tip("the data's box, with ticks in their units (O)");
    // Folded: in the room nothing has to be scrolled to.
    bool* const open = ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID("look"), false);
    ImGui::SameLine();
    if (ImGui::SmallButton(*open ? "hide lighting" : "lighting ..."))
        *open = !*open;
    tip("material, background and ambient occlusion");
    if (*open)
        look_section(model, commands);
}

} // namespace isochron::app
