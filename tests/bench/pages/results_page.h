// The page of results: what was measured, next to the paper's tables and to the goals.
#pragma once

#include "tests/bench/pages/rows.h"

#include <functional>
#include <string>

namespace isochron::bench {

/// Files of results, as the page names them; empty: that part is left out.
struct ResultPaths {
    std::string index, render, artifacts, scale = {}, agreement = {};
};

/// All parts, as Markdown; the same results give the same text.
/// @param read gives a file's text
std::string whole_page(const ResultPaths& paths,
                       const std::function<std::string(const std::string&)>& read);

/// The part about the index, with the page's head.
std::string results_page(const Results& results, const ResultPaths& paths);

} // namespace isochron::bench
