// The page of results: the measured figures, next to the paper's tables and the goals.
#pragma once

#include "tests/bench/pages/rows.h"

#include <functional>
#include <string>

namespace isochron::bench {

/// Files of results, by their names on the page; empty: that part is left out.
struct ResultPaths {
    std::string index, render, artifacts, scale = {}, gpu = {}, agreement = {}, motion = {};
};

/// All parts, as Markdown; the same results give the same text.
/// @param read returns a file's text
std::string whole_page(const ResultPaths& paths,
                       const std::function<std::string(const std::string&)>& read);

/// The part on the index, with the page's head.
std::string results_page(const Results& results, const ResultPaths& paths);

} // namespace isochron::bench
