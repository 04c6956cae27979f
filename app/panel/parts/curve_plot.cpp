// A plot of curves over time.
#include "app/panel/parts/curve_plot.h"

#include "app/panel/parts/histogram.h"
#include "app/panel/parts/plot_zoom.h"
#include "app/panel/parts/theme.h"
#include "app/scene/ticks.h"
#include "index/volume/instant_text.h"
#include "index/volume/time_unit.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace isochron::app {
namespace {

constexpr float kBelow = 20.0f; ///< height of the axis of time
constexpr float kDot = 2.5f;

/// An axis from one number to another.
struct Axis {
    double low = 0, high = 1;
    bool logarithmic = false;
    Ticks ticks{};

    /// 0 to 1 within the axis. Halves keep spans finite for any two doubles.
    double share(double value) const {
        if (logarithmic)
            return std::log(value / low) / std::log(high / low);
        const double half = high / 2 - low / 2;
        return half > 0 ? (value / 2 - low / 2) / half : 0.5;
    }
};

/// How far below the upper end of an axis its first number stands, which the unit leaves free.
float begin_of_numbers(const std::string& unit) {
    return unit.empty() ? 0.0f : ImGui::GetFontSize() + 2.0f;
}

/// Round numbers along an axis. Two at least have room for their words, where that can be.
Ticks legible_ticks(const Axis& axis, int most, float height, float begin) {
    constexpr float kLeastApart = 15.0f;
    Ticks ticks = nice_ticks(axis.low, axis.high, most);
    const auto is_legible = [&](double value) {
        return height * static_cast<float>((axis.high - value) / (axis.high - axis.low)) >= begin;
    };
    while (std::ranges::count_if(ticks.values, is_legible) < 2 &&
           static_cast<float>(++most) * kLeastApart <= height + kLeastApart)
        ticks = nice_ticks(axis.low, axis.high, most);
    return ticks;
}

/// The numbers that are plotted, and a little room; from 0 on where that is not far away.
Axis number_axis(const PlottedCurves& curves, float height) {
    constexpr float kApart = 26.0f; // between ticks, panel pixels
    const int most = std::max(2, static_cast<int>(height / kApart));
    double low = std::numeric_limits<double>::infinity(), high = -low;
    const auto take = [&](double value) {
        if (!std::isfinite(value) || (curves.logarithmic && !(value > 0)))
            return;
        low = std::min(low, value);
        high = std::max(high, value);
    };
    for (const PlottedLine& line : curves.lines)
        std::ranges::for_each(line.values, take);
    for (const PlottedLevel& level : curves.levels)
        take(level.value);
    if (low > high)
        return {.low = curves.logarithmic ? 1.0 : 0.0, .high = 10.0};
    Axis axis{.low = low, .high = high, .logarithmic = curves.logarithmic};
    if (curves.logarithmic) {
        axis.low = low / 1.1;
        axis.high = high * 1.1;
        axis.ticks = logarithmic_ticks(axis.low, axis.high, most);
        if (axis.ticks.values.size() < 2)
            axis.ticks = nice_ticks(axis.low, axis.high, most);
        return axis;
    }
    constexpr double kNear = 0.6; // share of the highest from which 0 would squeeze the curves
    const double span = high - low;
    if (low >= 0 && low < kNear * high)
        axis.low = 0;
    else
        axis.low -= span > 0 ? 0.06 * span : std::max(std::abs(low) * 0.05, 0.5);
    axis.high += span > 0 ? 0.06 * span : std::max(std::abs(high) * 0.05, 0.5);
    if (high == 0 && low == 0)
        axis = {.low = 0, .high = 1};
    axis.ticks = legible_ticks(axis, most, height, begin_of_numbers(curves.unit));
    return axis;
}

/// The plot's frame, and where numbers and times lie in it.
struct Frame2D {
    ImVec2 low, high; ///< upper left, lower right
    Axis x, y;

    float x_of(double time) const {
        return low.x + static_cast<float>(x.share(time)) * (high.x - low.x);
    }
    float y_of(double value) const {
        return high.y - static_cast<float>(y.share(value)) * (high.y - low.y);
    }
};

float widest_number(const Axis& axis) {
    float widest = 0;
    for (const double value : axis.ticks.values)
        widest = std::max(widest,
                          ImGui::CalcTextSize(
                              tick_text(value, axis.logarithmic ? value : axis.ticks.step).c_str())
                              .x);
    return widest;
}

void numbers_on(const Frame2D& frame, const std::string& unit) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float half = ImGui::GetFontSize() / 2;
    const float begin = frame.low.y + begin_of_numbers(unit);
    for (const double value : frame.y.ticks.values) {
        const float y = std::round(frame.y_of(value));
        const std::string text = tick_text(value, frame.y.logarithmic ? value : frame.y.ticks.step);
        list.AddLine({frame.low.x, y}, {frame.high.x, y}, packed(Ink::line));
        if (y < begin)
            continue;
        const float width = ImGui::CalcTextSize(text.c_str()).x;
        list.AddText({frame.low.x - width - 6.0f, y - half}, packed(Ink::dim), text.c_str());
    }
    if (!unit.empty()) {
        const float width = ImGui::CalcTextSize(unit.c_str()).x;
        list.AddText({std::max(frame.low.x - width - 6.0f, ImGui::GetCursorScreenPos().x),
                      frame.low.y - half},
                     packed(Ink::dim), unit.c_str());
    }
}

/// Round times with their unit, or dates of some steps.
void times_on(const Frame2D& frame, const PlottedCurves& curves) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool dates = index::has_dates(curves.times, curves.time_unit);
    const float unit_width =
        dates || curves.time_unit.empty() ? 0 : ImGui::CalcTextSize(curves.time_unit.c_str()).x;
    const float y = frame.high.y + 4.0f, end = frame.high.x - (unit_width > 0 ? unit_width + 8 : 0);
    if (unit_width > 0)
        list.AddText({frame.high.x - unit_width, y}, packed(Ink::dim), curves.time_unit.c_str());
    float taken = frame.low.x - 1.0f;
    const auto label = [&](double time, const std::string& text) {
        const float width = ImGui::CalcTextSize(text.c_str()).x, x = frame.x_of(time);
        const float left =
            std::clamp(x - width / 2, frame.low.x, std::max(frame.low.x, frame.high.x - width));
        if (x < frame.low.x - 1 || x > frame.high.x + 1)
            return;
        if (left < taken || left + width > end)
            return;
        list.AddLine({x, frame.high.y}, {x, frame.high.y + 3.0f}, packed(Ink::dim));
        list.AddText({left, y}, packed(Ink::dim), text.c_str());
        taken = left + width + 10.0f;
    };
    const auto steps = static_cast<std::uint32_t>(curves.times.size());
    const auto text_of = [&](std::uint32_t step) {
        return index::instant_text(curves.times, index::Instant(step),
                                   dates ? curves.time_unit : std::string());
    };
    constexpr float kApart = 70.0f; // panel pixels
    const Ticks ticks =
        nice_ticks(frame.x.low, frame.x.high,
                   std::max(2, static_cast<int>((frame.high.x - frame.low.x) / kApart)));
    if (dates || ticks.values.empty())
        for (std::uint32_t step = 0; step < steps; ++step)
            label(curves.times[step], text_of(step));
    else
        for (const double time : ticks.values)
            label(time, tick_text(time, ticks.step));
}

/// The points of a line without a gap; where many of them share a column of pixels, those of its
/// lowest and highest number.
void thin_out(std::vector<ImVec2>& points) {
    std::vector<ImVec2> kept;
    for (std::size_t begin = 0, end; begin < points.size(); begin = end) {
        const float column = std::floor(points[begin].x);
        for (end = begin + 1; end < points.size() && std::floor(points[end].x) == column;)
            ++end;
        if (end - begin < 3) {
            kept.insert(kept.end(), points.begin() + static_cast<std::ptrdiff_t>(begin),
                        points.begin() + static_cast<std::ptrdiff_t>(end));
            continue;
        }
        const auto [low, high] =
            std::minmax_element(points.begin() + static_cast<std::ptrdiff_t>(begin),
                                points.begin() + static_cast<std::ptrdiff_t>(end),
                                [](const ImVec2& a, const ImVec2& b) { return a.y < b.y; });
        kept.push_back(std::min(low, high) == low ? *low : *high);
        kept.push_back(std::min(low, high) == low ? *high : *low);
    }
    points = std::move(kept);
}

void line_on(const Frame2D& frame, const PlottedCurves& curves, const PlottedLine& line) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float thick = line.picked ? 2.5f : 1.75f;
    const ImU32 rim = rim_of(line.color);
    const bool dots =
        curves.times.size() * 8 < static_cast<std::size_t>(frame.high.x - frame.low.x);
    std::vector<std::vector<ImVec2>> runs(1);
    for (std::size_t i = 0; i < std::min(line.values.size(), curves.times.size()); ++i) {
        const double value = line.values[i];
        if (std::isfinite(value) && (!curves.logarithmic || value > 0))
            runs.back().push_back({frame.x_of(curves.times[i]), frame.y_of(value)});
        else if (!runs.back().empty())
            runs.emplace_back();
    }
    for (const auto& [color, wider] : {std::pair(rim, 1.5f), std::pair(line.color, 0.0f)})
        for (std::vector<ImVec2>& run : runs) {
            if (run.size() > 1 && wider > 0)
                thin_out(run);
            list.AddPolyline(run.data(), static_cast<int>(run.size()), color, 0, thick + wider);
            if (dots || run.size() == 1)
                for (const ImVec2& at : run)
                    list.AddCircleFilled(at, kDot + wider / 2, color);
        }
}

void crossings_on(const Frame2D& frame, const PlottedCurves& curves, const PlottedLevel& level) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float y = std::round(frame.y_of(level.value));
    for (float x = frame.low.x; x < frame.high.x; x += 8.0f)
        list.AddLine({x, y}, {std::min(x + 4.0f, frame.high.x), y}, level.color);
    for (const PlottedLine& line : curves.lines)
        for (const Crossing& at : crossings_of(line.values, level.value)) {
            const double time = at.share == 0 ? curves.times[at.step]
                                              : std::lerp(curves.times[at.step],
                                                          curves.times[at.step + 1], at.share);
            list.AddCircleFilled({frame.x_of(time), y}, 5.0f, rim_of(level.color));
            list.AddCircleFilled({frame.x_of(time), y}, 4.0f, level.color);
        }
}

void dots_at(const Frame2D& frame, const PlottedCurves& curves, std::uint32_t step) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (const PlottedLine& line : curves.lines) {
        const double value = step < line.values.size() ? line.values[step] : 0;
        if (!std::isfinite(value) || (curves.logarithmic && !(value > 0)))
            continue;
        const ImVec2 at(frame.x_of(curves.times[step]), frame.y_of(value));
        list.AddCircleFilled(at, 5.5f, rim_of(line.color));
        list.AddCircleFilled(at, 4.5f, line.color);
    }
}

std::uint32_t nearest_step(std::span<const double> times, double time) {
    const auto after = std::ranges::lower_bound(times, time);
    if (after == times.begin())
        return 0;
    const auto step = static_cast<std::uint32_t>(after - times.begin());
    if (after == times.end() || time - times[step - 1] < times[step] - time)
        return step - 1;
    return step;
}

} // namespace

std::vector<Crossing> crossings_of(std::span<const double> values, double level) {
    std::vector<Crossing> found;
    for (std::size_t i = 0; i + 1 < values.size(); ++i) {
        const double here = values[i], there = values[i + 1];
        if (!std::isfinite(here) || !std::isfinite(there) || (here >= level) == (there >= level))
            continue;
        // Halves keep the differences finite; rounding may reach the next step.
        const double share = (level / 2 - here / 2) / (there / 2 - here / 2);
        const bool whole = share >= 1;
        found.push_back(
            {static_cast<std::uint32_t>(whole ? i + 1 : i), whole ? 0 : share, here < level});
    }
    return found;
}

PlotUse curve_plot(const PlottedCurves& curves, const ImVec2& size) {
    ImGuiStorage& kept = *ImGui::GetStateStorage();
    float* const seen_low = kept.GetFloatRef(ImGui::GetID("from"), 0.0f);
    float* const seen_high = kept.GetFloatRef(ImGui::GetID("to"), 1.0f);
    Zoom zoom{*seen_low, *seen_high};
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float half = ImGui::GetFontSize() / 2;
    Frame2D frame{
        {corner.x, corner.y + half}, {corner.x + size.x, corner.y + size.y - kBelow}, {}, {}};
    frame.y = number_axis(curves, frame.high.y - frame.low.y);
    const float margin =
        std::min(std::max({widest_number(frame.y),
                           std::min(ImGui::CalcTextSize(curves.unit.c_str()).x, 60.0f), 30.0f}) +
                     8.0f,
                 size.x / 2);
    frame.low.x += margin;
    frame.high.x -= 6.0f; // for the last dot
    const double first = curves.times.front(), last = curves.times.back();
    frame.x = {.low = std::lerp(first, last, static_cast<double>(zoom.low)),
               .high = std::lerp(first, last, static_cast<double>(zoom.high))};
    numbers_on(frame, curves.unit);
    ImGui::SetCursorScreenPos({frame.low.x - 6.0f, corner.y});
    ImGui::InvisibleButton("plot", {frame.high.x - frame.low.x + 12.0f, size.y});
    PlotUse use;
    const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
    const float share = std::clamp(
        (ImGui::GetIO().MousePos.x - frame.low.x) / (frame.high.x - frame.low.x), 0.0f, 1.0f);
    if (hovered || active)
        use.pointed = nearest_step(
            curves.times, std::lerp(frame.x.low, frame.x.high, static_cast<double>(share)));
    use.pressed = active;
    if (hovered) {
        ImGui::SetItemUsingMouseWheel();
        zoom.turn(ImGui::GetIO().MouseWheel, share);
        *seen_low = zoom.low;
        *seen_high = zoom.high;
    }
    times_on(frame, curves);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddLine({frame.low.x, frame.low.y}, {frame.low.x, frame.high.y}, packed(Ink::dim));
    list.AddLine({frame.low.x, frame.high.y}, frame.high, packed(Ink::dim));
    list.PushClipRect({frame.low.x - 6, frame.low.y - 6}, {frame.high.x + 6, frame.high.y + 6},
                      true);
    const auto upright = [&](double time, ImU32 color, float thick) {
        const float x = frame.x_of(time);
        list.AddLine({x, frame.low.y}, {x, frame.high.y}, color, thick);
    };
    if (use.pointed)
        upright(curves.times[*use.pointed], packed(Ink::dim), 1.0f);
    if (curves.now)
        upright(index::time_at(curves.times, *curves.now), packed(Ink::accent), 2.0f);
    for (const bool picked : {false, true})
        for (const PlottedLine& line : curves.lines)
            if (line.picked == picked)
                line_on(frame, curves, line);
    for (const PlottedLevel& level : curves.levels)
        crossings_on(frame, curves, level);
    if (curves.now && !curves.now->between())
        dots_at(frame, curves, curves.now->step);
    if (use.pointed)
        dots_at(frame, curves, *use.pointed);
    list.PopClipRect();
    ImGui::SetCursorScreenPos({corner.x, corner.y + size.y});
    return use;
}

} // namespace isochron::app
