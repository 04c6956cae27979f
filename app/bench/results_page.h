// The page of results: what was measured, next to the paper's tables and to the goals.
#pragma once

#include "app/bench/rows.h"

#include <string>

namespace isochron::app::bench {

/// Markdown; the same results give the same text.
/// @param source the file that the results come from, as the page names it
std::string results_page(const Results& results, const std::string& source);

} // namespace isochron::app::bench
