// A goal for a figure, and its comparison with the measured ones.
#pragma once

#include "tests/bench/pages/short_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace isochron::bench {

template <class Row>
struct Goal {
    std::string what;
    std::string unit;   ///< written after every number
    double goal, floor; ///< upper limits, or lower limits if `more`
    bool more;          ///< larger figures are better
    std::function<std::optional<double>(const Row&)> figure; ///< empty for rows it does not concern

    bool reaches(double measured, double bound) const {
        return more ? measured >= bound : measured <= bound;
    }
};

/// A line of Markdown: the goal, the range of the figures of all rows that it concerns, and the
/// verdict on the worst of them.
template <class Row>
std::string line_of(const Goal<Row>& goal, const std::vector<Row>& rows) {
    std::vector<double> measured;
    for (const Row& row : rows)
        if (const auto figure = goal.figure(row))
            measured.push_back(*figure);
    std::string found = "-", verdict = "not measured";
    if (!measured.empty()) {
        const auto [low, high] = std::minmax_element(measured.begin(), measured.end());
        const double worst = goal.more ? *low : *high;
        found = *low == *high ? short_number(*low) + goal.unit
                              : short_number(*low) + " to " + short_number(*high) + goal.unit;
        verdict = goal.reaches(worst, goal.goal)    ? "goal reached"
                  : goal.reaches(worst, goal.floor) ? "above the floor"
                                                    : "**below the floor**";
    }
    return fmt::format("| {} | {}{} | {}{} | {} | {} |\n", goal.what, goal.goal, goal.unit,
                       goal.floor, goal.unit, found, verdict);
}

/// All goals as a table in Markdown.
template <class Row>
std::string table_of(const std::vector<Goal<Row>>& goals, const std::vector<Row>& rows) {
    std::string text = "| what | goal | floor | measured | |\n|---|---|---|---|---|\n";
    for (const Goal<Row>& goal : goals)
        text += line_of(goal, rows);
    return text;
}

} // namespace isochron::bench
