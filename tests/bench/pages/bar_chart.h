// Charts of a few horizontal bars, as SVG.
#pragma once

#include <string>
#include <vector>

namespace isochron::bench {

struct Bar {
    std::string label;
    double value = 0;
    std::string text;  ///< the value as people read it: `18.4 us`
    bool ours = false; ///< in the color of this program; else gray, for comparison
};

struct BarChart {
    std::string title; ///< with the unit
    std::vector<Bar> bars;
    bool logarithmic = false; ///< lengths by the logarithm; a title should say so
    /// A value with a line and a name of its own, such as a budget; below 0: none.
    double mark = -1;
    std::string mark_text = {};
};

/// The chart on a background of its own, so that dark pages show it, too; with a title and
/// descriptions for readers who do not see it. The same chart gives the same text.
std::string svg_of(const BarChart& chart);

} // namespace isochron::bench
