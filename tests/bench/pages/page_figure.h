// A figure of the first page of the results, and the results that figures are taken from.
#pragma once

#include "tests/bench/pages/agreement_rows.h"
#include "tests/bench/pages/bar_chart.h"
#include "tests/bench/pages/render_rows.h"
#include "tests/bench/pages/rows.h"

#include <optional>
#include <string>

namespace isochron::bench {

/// Results that the figures are taken from, with the names of their files. A figure is left out
/// where its results are not there.
struct FirstPageInput {
    struct {
        std::string index, render, agreement, scale, gpu;
    } names;
    std::optional<Results> index = {};
    std::optional<RenderResults> render = {};
    std::optional<AgreementResults> agreement = {};
    std::string scale = {}; ///< what `isochron-bench scale` printed
    std::string gpu = {};   ///< what programs printed where a GPU drew
};

/// A figure: its heading, what it says, where it comes from, and its chart.
struct PageFigure {
    std::string name; ///< of the chart's file, without its end
    std::string heading, text, source;
    BarChart chart;
};

} // namespace isochron::bench
