// The goals of the picture in motion, compared with the measured figures.
#include "tests/bench/pages/goal.h"
#include "tests/bench/pages/motion_page.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string_view>

namespace isochron::bench {
namespace {

using MotionFigure = std::function<std::optional<double>(const MotionRow&)>;
using Names = std::initializer_list<std::string_view>;

constexpr int kSide = 1024; ///< of the pictures for which most goals are given

bool is_one_of(const std::vector<std::string_view>& names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
}

/// The figure for rows of these data and of a budget [ms], in square pictures.
MotionFigure in_squares(Names data, double budget_ms, const MotionFigure& figure) {
    return [data = std::vector<std::string_view>(data), budget_ms,
            figure](const MotionRow& row) -> std::optional<double> {
        if (!is_one_of(data, row.data) || row.width != kSide || row.height != kSide ||
            std::abs(row.budget_ms - budget_ms) > 0.01)
            return std::nullopt;
        return figure(row);
    };
}

/// The figure for rows of these data and motions without a window.
MotionFigure windowless(Names data, Names motions, const MotionFigure& figure) {
    return [data = std::vector<std::string_view>(data),
            motions = std::vector<std::string_view>(motions),
            figure](const MotionRow& row) -> std::optional<double> {
        if (!is_one_of(data, row.data) || row.place == "window" ||
            (!motions.empty() && !is_one_of(motions, row.motion)))
            return std::nullopt;
        return figure(row);
    };
}

std::optional<double> lit_off(const MotionRow& row) {
    return 100 * std::abs(row.lit - 1);
}
std::optional<double> overlap(const MotionRow& row) {
    return row.overlap;
}
std::optional<double> luminance(const MotionRow& row) {
    return 100 * row.luminance_off;
}
std::optional<double> exact(const MotionRow& row) {
    constexpr double kNever = 1e6;
    return 1e-3 * row.exact_ms.value_or(kNever);
}
std::optional<double> recognizable_rate(const MotionRow& row) {
    if (row.place != "window" || row.data != "192" || row.motion != "orbit")
        return std::nullopt;
    return row.recognizable * row.per_second;
}
std::optional<double> beyond_two(const MotionRow& row) {
    return 100 * std::max(0.0, row.over_two - row.control_two);
}
std::optional<double> beyond_three(const MotionRow& row) {
    return 100 * std::max(0.0, row.over_three - row.control_three);
}
std::optional<double> busy(const MotionRow& row) {
    return row.busy;
}
std::optional<double> shown(const MotionRow& row) {
    return row.shown_ms;
}
std::optional<double> shown_late(const MotionRow& row) {
    return row.shown_late_ms;
}

std::vector<Goal<MotionRow>> all_motion_goals() {
    const Names smaller{"demo", "192", "256"}, asks{"scrub", "jump-on"};
    return {
        {"1024^2, 33 ms, 64^3 to 256^3: lit area off", " %", 6, 10, false,
         in_squares(smaller, 33, lit_off)},
        {"the same: IoU", "", 0.94, 0.90, true, in_squares(smaller, 33, overlap)},
        {"the same: luminance off", " %", 8, 15, false, in_squares(smaller, 33, luminance)},
        {"1024^2, 33 ms, 512^3: IoU", "", 0.90, 0.85, true, in_squares({"512"}, 33, overlap)},
        {"1024^2, 16.7 ms, 64^3: IoU", "", 0.98, 0.96, true, in_squares({"demo"}, 16.7, overlap)},
        {"the same, 256^3", "", 0.94, 0.90, true, in_squares({"256"}, 16.7, overlap)},
        {"the same, 192^3", "", 0.88, 0.78, true, in_squares({"192"}, 16.7, overlap)},
        {"1024^2, 8.3 ms, 64^3: IoU", "", 0.97, 0.95, true, in_squares({"demo"}, 8.3, overlap)},
        {"the same, 256^3", "", 0.90, 0.85, true, in_squares({"256"}, 8.3, overlap)},
        {"1024^2, 100 ms, 64^3 to 256^3: IoU", "", 0.99, 0.97, true,
         in_squares(smaller, 100, overlap)},
        {"the same, 512^3", "", 0.95, 0.92, true, in_squares({"512"}, 100, overlap)},
        {"orbit of 192^3, default window: recognizable pictures", "/s", 30, 20, true,
         recognizable_rate},
        {"frames over two promised times, beyond the control", " %", 1, 2, false, beyond_two},
        {"frames over three promised times, beyond the control", " %", 0.1, 0.5, false,
         beyond_three},
        {"asked to shown, 64^3, median", " ms", 20, 40, false, windowless({"demo"}, asks, shown)},
        {"the same, 95 %", " ms", 40, 80, false, windowless({"demo"}, asks, shown_late)},
        {"asked to shown, 256^3, median", " ms", 50, 80, false, windowless({"256"}, asks, shown)},
        {"the same, 95 %", " ms", 120, 200, false, windowless({"256"}, asks, shown_late)},
        {"asked to shown, 512^3, median", " ms", 100, 200, false, windowless({"512"}, asks, shown)},
        {"the same, 95 %", " ms", 250, 500, false, windowless({"512"}, asks, shown_late)},
        {"exact after stopping, 64^3", " s", 0.1, 0.3, false, windowless({"demo"}, {}, exact)},
        {"exact after stopping, 192^3 and 256^3", " s", 0.6, 1.2, false,
         windowless({"192", "256"}, {}, exact)},
        {"exact after stopping, 512^3 with 2.4 M cells", " s", 2, 4, false,
         windowless({"512-dense"}, {}, exact)},
        {"exact after stopping, 1024^3 with 3 M cells", " s", 4, 6, false,
         windowless({"1024"}, {}, exact)},
        {"processors busy while drawing, of two", "", 1.9, 1.7, true, busy},
    };
}

} // namespace

std::string motion_goals_table(const std::vector<MotionRow>& rows) {
    return table_of(all_motion_goals(), rows);
}

} // namespace isochron::bench
