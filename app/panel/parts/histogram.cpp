// The histogram of all values, with a line for each surface that the user drags.
#include "app/panel/parts/histogram.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/plot_zoom.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/theme.h"
#include "app/scene/ticks.h"
#include "app/text.h"

#include <glm/vec3.hpp>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

namespace isochron::app {
namespace {

using interaction::Commands;

constexpr float kPlotHeight = 120.0f, kAxisHeight = 20.0f;
constexpr float kReach = 7.0f; ///< how far from a line the hand takes it, panel pixels
constexpr int kNobody = -1;

/// Where values lie in the plot.
struct Plot {
    ImVec2 low, high; ///< upper left, lower right
    double first, last;

    bool has_span() const { return last / 2 - first / 2 > 0; }
    /// Halves keep the span finite for any two doubles.
    float x_of(double value) const {
        const double half_span = last / 2 - first / 2;
        const double share =
            half_span > 0 ? std::clamp((value / 2 - first / 2) / half_span, 0.0, 1.0) : 0.5;
        return low.x + static_cast<float>(share) * (high.x - low.x);
    }
    double value_at(float x) const {
        return std::lerp(
            first, last,
            static_cast<double>(std::clamp((x - low.x) / (high.x - low.x), 0.0f, 1.0f)));
    }
};

void columns(const Plot& plot, const Zoom& zoom, const std::vector<std::uint64_t>& bins,
             bool logarithmic) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(plot.low, plot.high, packed(Ink::control), ImGui::GetStyle().FrameRounding);
    if (bins.empty())
        return;
    const auto scaled = [logarithmic](std::uint64_t count) {
        const auto number = static_cast<double>(count);
        return logarithmic ? std::log1p(number) : number;
    };
    const auto number = static_cast<float>(bins.size());
    const auto first = static_cast<std::size_t>(zoom.low * number);
    const auto end =
        std::clamp(static_cast<std::size_t>(std::ceil(zoom.high * number)), first + 1, bins.size());
    const double most =
        std::max(scaled(*std::max_element(bins.begin() + static_cast<std::ptrdiff_t>(first),
                                          bins.begin() + static_cast<std::ptrdiff_t>(end))),
                 1e-9);
    const float room = plot.high.y - plot.low.y - 12.0f; // the handles lie above
    const auto x_of = [&](std::size_t bin) {
        const float share = (static_cast<float>(bin) / number - zoom.low) / (zoom.high - zoom.low);
        return std::lerp(plot.low.x, plot.high.x, std::clamp(share, 0.0f, 1.0f));
    };
    for (std::size_t bin = first; bin < end; ++bin) {
        const float height = room * static_cast<float>(scaled(bins[bin]) / most);
        list.AddRectFilled({x_of(bin), plot.high.y - height}, {x_of(bin + 1), plot.high.y},
                           packed(Ink::columns));
    }
}

void axis(const Plot& plot, const std::string& unit) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 unit_size = ImGui::CalcTextSize(unit.c_str());
    const bool shows_unit = !unit.empty() && unit_size.x < 0.3f * (plot.high.x - plot.low.x);
    const float end = shows_unit ? plot.high.x - unit_size.x - 8.0f : plot.high.x;
    const float y = plot.high.y + 4.0f;
    if (shows_unit)
        list.AddText({plot.high.x - unit_size.x, y}, packed(Ink::dim), unit.c_str());
    const Ticks ticks = nice_ticks(plot.first, plot.last, 5);
    float taken = plot.low.x - 1.0f;
    for (const double value : ticks.values) {
        const std::string text = tick_text(value, ticks.step);
        const float width = ImGui::CalcTextSize(text.c_str()).x, x = plot.x_of(value);
        const float left = std::clamp(x - width / 2, plot.low.x, std::max(plot.low.x, end - width));
        if (left < taken || left + width > end || std::abs(left + width / 2 - x) > width / 2 + 1)
            continue;
        list.AddLine({x, plot.high.y}, {x, plot.high.y + 3.0f}, packed(Ink::dim));
        list.AddText({left, y}, packed(Ink::dim), text.c_str());
        taken = left + width + 8.0f;
    }
}

void line_at(const Plot& plot, double value, ImU32 color, bool picked) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float x = plot.x_of(value), thick = picked ? 2.0f : 1.5f;
    const ImU32 rim = rim_of(color);
    list.AddLine({x, plot.low.y}, {x, plot.high.y}, rim, thick + 2.0f);
    list.AddLine({x, plot.low.y}, {x, plot.high.y}, color, thick);
    list.AddCircleFilled({x, plot.low.y + 5.0f}, picked ? 6.0f : 4.5f, rim);
    list.AddCircleFilled({x, plot.low.y + 5.0f}, picked ? 5.0f : 3.5f, color);
}

/// The array, where it is not the shown one, in the upper left corner.
void name_of_array(const Plot& plot, const PanelModel& model) {
    constexpr float kSpared = 40.0f,
                    kBelow = 14.0f; // for the word in the other corner, and handles
    if (!model.arrays.of(model.asked.picked))
        return;
    const float width = plot.high.x - plot.low.x - kSpared;
    const std::string name = cut_to(model.picked_info().array, width);
    ImGui::GetWindowDrawList()->AddText({plot.low.x + 6.0f, plot.low.y + kBelow}, packed(Ink::text),
                                        name.c_str());
}

/// Surfaces of the picked one's array have lines.
bool is_in_histogram(const PanelModel& model, std::size_t surface) {
    return model.arrays.of(surface) == model.arrays.of(model.asked.picked);
}

/// The surface whose line is nearest to a place and within reach.
std::optional<std::uint32_t> line_near(const Plot& plot, const PanelModel& model, float x) {
    std::optional<std::uint32_t> nearest;
    float distance = kReach;
    for (std::uint32_t i = 0; i < model.asked.isosurfaces.size(); ++i) {
        if (!is_in_histogram(model, i))
            continue;
        const float away = std::abs(plot.x_of(model.asked.isosurfaces[i].isovalue) - x);
        if (away < distance || (away == distance && i == model.asked.picked)) {
            distance = away;
            nearest = i;
        }
    }
    return nearest;
}

/// Linear or logarithmic counts: a word in the plot's corner.
/// Beside it the whole range again, where a part of it is seen.
void scale_choice(const Plot& plot, bool& logarithmic, Zoom& zoom) {
    const char* word = logarithmic ? "log" : "lin";
    const ImVec2 size = ImGui::CalcTextSize(word);
    const ImVec2 corner(plot.high.x - size.x - 12.0f, plot.low.y + 14.0f);
    const ImVec2 after = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos(corner);
    if (ImGui::Button(word, {size.x + 10.0f, size.y + 4.0f}))
        logarithmic = !logarithmic;
    tip("heights of the columns: logarithmic or linear");
    if (!zoom.is_whole()) {
        const float all = ImGui::CalcTextSize("all").x + 10.0f;
        ImGui::SetCursorScreenPos({corner.x - all - 4.0f, corner.y});
        if (ImGui::Button("all", {all, size.y + 4.0f}))
            zoom = {};
        tip("the whole range of values again");
    }
    ImGui::SetCursorScreenPos(after);
}

/// The values on screen, where they are not yet those that were asked for.
void lines_behind(const Plot& plot, const PanelModel& model) {
    const auto& shown = model.frame.shown;
    if (!shown)
        return;
    const std::size_t surfaces = std::min(shown->isovalues.size(), model.asked.isosurfaces.size());
    for (std::size_t i = 0; i < surfaces; ++i)
        if (model.asked.isosurfaces[i].of_shown_array() && is_in_histogram(model, i) &&
            shown->isovalues[i] != model.asked.isosurfaces[i].isovalue) {
            const float x = plot.x_of(shown->isovalues[i]);
            ImGui::GetWindowDrawList()->AddLine({x, plot.low.y + 12.0f}, {x, plot.high.y},
                                                packed(Ink::dim));
        }
}

} // namespace

std::vector<std::uint64_t> column_counts(const PanelModel& model) {
    const index::SeriesInfo& info = model.picked_info();
    const index::IndexStats& stats = model.picked_stats();
    const std::vector<std::uint64_t>& bins = stats.histogram;
    const double between = (stats.high - stats.low) / info.scaling.slope;
    const auto bin_count = static_cast<double>(bins.size());
    if (info.type >= index::ValueType::f32 || !(std::abs(between) < bin_count))
        return bins;
    const double wide = bin_count / std::max(1.0, std::round(std::abs(between)));
    std::vector<std::uint64_t> counts;
    for (std::size_t bin = 0; bin + 1 < bins.size(); ++bin) {
        const double number = std::ceil((static_cast<double>(bin) + 1) / wide) - 1;
        counts.push_back(bins[static_cast<std::size_t>(number * wide)]);
    }
    if (!bins.empty()) // the last bin holds the highest number alone
        counts.push_back(bins.back());
    return counts;
}

ImU32 rim_of(ImU32 color) {
    const ImVec4 c = ImGui::ColorConvertU32ToFloat4(color);
    const bool light = 0.3f * c.x + 0.59f * c.y + 0.11f * c.z > 0.45f;
    return light ? IM_COL32(20, 22, 26, 230) : IM_COL32(240, 242, 245, 230);
}

ImU32 line_color(const interaction::Isosurface& surface) {
    const glm::vec3& color = surface.color;
    return ImGui::ColorConvertFloat4ToU32({color.x, color.y, color.z, 1.0f});
}

void histogram(const PanelModel& model, Commands& commands) {
    ImGuiStorage& kept = *ImGui::GetStateStorage();
    bool* const logarithmic = kept.GetBoolRef(ImGui::GetID("logarithmic"), true);
    int* const grabbed = kept.GetIntRef(ImGui::GetID("grabbed"), kNobody);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    float* const seen_low = kept.GetFloatRef(ImGui::GetID("low"), 0.0f);
    float* const seen_high = kept.GetFloatRef(ImGui::GetID("high"), 1.0f);
    Zoom zoom{*seen_low, *seen_high};
    const index::IndexStats& stats = model.picked_stats();
    const Plot plot{corner,
                    {corner.x + width, corner.y + kPlotHeight},
                    std::lerp(stats.low, stats.high, static_cast<double>(zoom.low)),
                    std::lerp(stats.low, stats.high, static_cast<double>(zoom.high))};
    ImGui::InvisibleButton("histogram", {width, kPlotHeight});
    ImGui::SetItemAllowOverlap(); // the word in its corner
    const bool active = ImGui::IsItemActive(), hovered = ImGui::IsItemHovered();
    const float pointed = ImGui::GetIO().MousePos.x;
    if (hovered) {
        ImGui::SetItemUsingMouseWheel(); // the column does not scroll then
        zoom.turn(ImGui::GetIO().MouseWheel, std::clamp((pointed - corner.x) / width, 0.0f, 1.0f));
    }
    columns(plot, zoom, column_counts(model), *logarithmic);
    lines_behind(plot, model);
    const auto& surfaces = model.asked.isosurfaces;
    for (std::uint32_t i = 0; i < surfaces.size(); ++i)
        if (i != model.asked.picked && is_in_histogram(model, i))
            line_at(plot, surfaces[i].isovalue, line_color(surfaces[i]), false);
    line_at(plot, model.asked.isovalue(), line_color(surfaces[model.asked.picked]), true);
    axis(plot, model.picked_info().value_unit);
    name_of_array(plot, model);
    if (ImGui::IsItemActivated())
        *grabbed = static_cast<int>(line_near(plot, model, pointed).value_or(model.asked.picked));
    if (active && plot.has_span()) {
        const auto surface = static_cast<std::uint32_t>(*grabbed);
        if (surface != model.asked.picked && surface < surfaces.size())
            commands.picked = surface;
        commands.isovalue = plot.value_at(pointed);
    }
    const index::SeriesInfo& info = model.picked_info();
    if (hovered && plot.has_span())
        ImGui::SetTooltip("%s\nthe wheel zooms",
                          with_unit(plot.value_at(pointed), info.value_unit, info.digits).c_str());
    scale_choice(plot, *logarithmic, zoom);
    *seen_low = zoom.low;
    *seen_high = zoom.high;
    ImGui::Dummy({width, kAxisHeight});
}

} // namespace isochron::app
