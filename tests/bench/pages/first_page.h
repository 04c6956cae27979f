// The first page of the results: ten figures that tell a user what to expect, each with a chart.
#pragma once

#include "tests/bench/pages/page_figure.h"

#include <string>
#include <vector>

namespace isochron::bench {

/// All figures whose results are there, in the order of the page.
std::vector<PageFigure> figures_of(const FirstPageInput& input);

/// The page in Markdown, empty without figures.
/// @param charts folder of the charts, from where the page lies
std::string first_page(const std::vector<PageFigure>& figures, const std::string& charts);

} // namespace isochron::bench
