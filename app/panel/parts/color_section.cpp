// The panel's section on color: what colors the surfaces, and the color map.
#include "app/panel/parts/color_section.h"

#include "app/panel/imgui/keyed_list.h"
#include "app/panel/panel_words.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/theme.h"
#include "app/scene/color_scale.h"
#include "app/text.h"
#include "render/gl/srgb.h"
#include "render/passes/color_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>

namespace isochron::app {
namespace {

using interaction::Coloring;
using interaction::Commands;

constexpr int kMostBandsOfField = 20;

void draw_gradient(const ColorScale& scale, const ImVec2& low, const ImVec2& high) {
    constexpr int kStrips = 48;
    const std::vector<glm::vec3> colors = colors_of(scale);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float width = (high.x - low.x) / kStrips;
    for (int strip = 0; strip < kStrips; ++strip) {
        const std::size_t at =
            (2 * static_cast<std::size_t>(strip) + 1) * colors.size() / (2 * kStrips);
        const glm::vec3 color = render::srgb_from_linear(colors[at]);
        const float left = low.x + width * static_cast<float>(strip);
        list.AddRectFilled({left, low.y}, {left + width, high.y},
                           ImGui::ColorConvertFloat4ToU32({color.x, color.y, color.z, 1.0f}));
    }
}

ColorScale scale_of(const Coloring& coloring) {
    ColorScale scale;
    scale.map = coloring.map;
    scale.colors = coloring.colors;
    scale.use = {coloring.reversed, coloring.bands};
    return scale;
}

void map_row(const PanelModel& model, Coloring& coloring) {
    row("map");
    const float width = ImGui::CalcItemWidth(), height = ImGui::GetFrameHeight();
    ImGui::SetNextItemWidth(width);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::SetNextWindowSizeConstraints({width, 0}, {400.0f, 600.0f});
    const bool open = ImGui::BeginCombo("##map", "", ImGuiComboFlags_HeightLarge);
    if (!open)
        tip(fmt::format("color map, from the lowest to the highest value: {}", coloring.map)
                .c_str());
    if (open) {
        const std::vector<OfferedMap> maps = offered_maps(model);
        const auto here = std::ranges::find(maps, coloring.map, &OfferedMap::name) - maps.begin();
        const KeyedList keys(static_cast<std::size_t>(here), maps.size());
        for (std::size_t i = 0; i < maps.size(); ++i) {
            const OfferedMap& map = maps[i];
            if (keys.line(i, ImGui::Selectable(map.words.c_str(), keys.at(i)))) {
                coloring.map = map.name;
                coloring.colors = map.colors;
            }
            const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
            Coloring sample = coloring;
            sample.map = map.name;
            sample.colors = map.colors;
            draw_gradient(scale_of(sample), {std::max(low.x + 92.0f, high.x - 92.0f), low.y + 3},
                          {high.x - 2, high.y - 3});
        }
        ImGui::EndCombo();
    }
    draw_gradient(scale_of(coloring), {corner.x + 3.0f, corner.y + 3.0f},
                  {corner.x + width - height - 2.0f, corner.y + height - 3.0f});
}

/// Two numbers, the lower one first. @return whether they have changed and are in order
bool two_numbers(const char* label, std::array<double, 2>& ends, const FieldRange& range,
                 const char* effect) {
    row(label);
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float half = (ImGui::CalcItemWidth() - gap) / 2;
    bool changed = false;
    for (std::size_t end = 0; end < 2; ++end) {
        if (end > 0)
            ImGui::SameLine();
        ImGui::SetNextItemWidth(half);
        ImGui::PushID(label);
        ImGui::PushID(static_cast<int>(end));
        changed = number_field("##end", ends[end], range, "%.5g") || changed;
        tip(effect);
        ImGui::PopID();
        ImGui::PopID();
    }
    return changed && ends[0] < ends[1];
}

/// @param shown the range of the scale @param values whose percentiles there are
void range_rows(const std::array<double, 2>& shown, const char* values, Coloring& coloring) {
    static const std::array<std::string, 3> kWays{"of all values", "percentiles", "set by hand"};
    const std::size_t way = coloring.range ? 2 : coloring.percentiles ? 1 : 0;
    row("range");
    const auto chosen = choice_field("##range", kWays[way], kWays, "values at the map's ends");
    if (chosen && *chosen != way) {
        coloring.range.reset();
        coloring.percentiles.reset();
        if (*chosen == 1)
            coloring.percentiles = {2.0, 98.0};
        else if (*chosen == 2)
            coloring.range = shown;
    }
    if (coloring.range) {
        std::array<double, 2> ends = *coloring.range;
        if (two_numbers("from, to", ends, {.low = shown[0], .high = shown[1], .bounded = false},
                        "lowest and highest value of the range"))
            coloring.range = ends;
    } else if (coloring.percentiles) {
        std::array<double, 2> ends = *coloring.percentiles;
        if (two_numbers("percent", ends, {.low = 0, .high = 100},
                        fmt::format("lowest and highest percentile of {}", values).c_str()))
            coloring.percentiles = ends;
    }
}

void use_rows(Coloring& coloring) {
    row("scale");
    tick_field("##logarithmic", coloring.logarithmic, "log");
    tip("logarithmic scale, for values above 0");
    ImGui::SameLine(0.0f, 14.0f);
    tick_field("##reversed", coloring.reversed, "reversed");
    tip("reverse the color map");
    row("bands");
    int bands = static_cast<int>(coloring.bands);
    if (whole_number_field("##bands", &bands, 0, kMostBandsOfField, bands == 0 ? "none" : "%d"))
        coloring.bands = static_cast<std::uint32_t>(bands);
    tip("number of discrete colors; 0: continuous");
}

/// What the surfaces can be colored by with these data.
std::vector<std::string> ways_to_color(const PanelModel& model) {
    std::vector<std::string> words{"surface", "first crossing"};
    if (!model.arrays.color_names.empty())
        words.insert(words.begin() + 1, "array");
    return words;
}

std::string words_for(interaction::ColorBy by) {
    switch (by) {
    case interaction::ColorBy::value: return "array";
    case interaction::ColorBy::first_crossing: return "first crossing";
    case interaction::ColorBy::surface: break;
    }
    return "surface";
}

void what_rows(const PanelModel& model, Coloring& coloring) {
    using enum interaction::ColorBy;
    const std::vector<std::string> words = ways_to_color(model);
    row("color by");
    const auto chosen =
        choice_field("##by", words_for(coloring.by), words, "what surfaces are colored by (U)");
    for (const interaction::ColorBy by : {surface, value, first_crossing})
        if (chosen && words[*chosen] == words_for(by) && by != coloring.by) {
            coloring.by = by;
            coloring.range.reset();
            break;
        }
    if (coloring.by != value || model.arrays.color_names.size() < 2)
        return;
    row("array");
    const std::vector<std::string> arrays(model.arrays.color_names.begin(),
                                          model.arrays.color_names.end());
    const auto array =
        choice_field("##array", arrays[model.arrays.color], arrays, "array to color by (Ctrl + U)");
    if (!array || *array == model.arrays.color)
        return;
    coloring.range.reset();
    coloring.array = arrays[*array];
}

/// How the values on slices are shown.
void slice_rows(const PanelModel& model, Commands& commands) {
    Coloring coloring = model.asked.slices.coloring;
    ImGui::PushID("slices");
    row("slices of");
    const std::vector<std::string> arrays(model.arrays.names.begin(), model.arrays.names.end());
    const auto chosen = choice_field("##array", arrays[model.colors.sliced], arrays,
                                     "array whose values the slices show");
    if (chosen && *chosen != model.colors.sliced) {
        coloring.array = arrays[*chosen];
        coloring.range.reset();
    }
    map_row(model, coloring);
    range_rows(model.colors.slices, "all values of the array", coloring);
    use_rows(coloring);
    ImGui::PopID();
    if (coloring == model.asked.slices.coloring)
        return;
    commands.slices = model.asked.slices;
    commands.slices->coloring = coloring;
}

} // namespace

std::vector<OfferedMap> offered_maps(const PanelModel& model) {
    std::vector<OfferedMap> maps;
    for (std::size_t i = 0; i < render::kColorMapNames.size(); ++i)
        maps.push_back({std::string(render::kColorMapNames[i]),
                        std::string(render::shown_name_of(static_cast<render::ColorMap>(i))),
                        {}});
    for (const LoadedColorMap& map : model.colors.own_maps)
        maps.push_back({map.name, map.name, map.colors});
    return maps;
}

void color_section(const PanelModel& model, Commands& commands) {
    Coloring coloring = model.asked.coloring;
    what_rows(model, coloring);
    if (coloring.by != interaction::ColorBy::surface) {
        map_row(model, coloring);
        range_rows(model.colors.range, "the values on the shown surfaces", coloring);
        use_rows(coloring);
    }
    if (coloring != model.asked.coloring)
        commands.coloring = coloring;
    if (model.asked.slices.shown())
        slice_rows(model, commands);
}

} // namespace isochron::app
