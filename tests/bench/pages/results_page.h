// The page of results: the measured figures, next to the paper's tables and the goals.
#pragma once

#include "tests/bench/pages/rows.h"

#include <functional>
#include <map>
#include <string>

namespace isochron::bench {

/// Files of results, by their names on the page; empty: that part is left out.
struct ResultPaths {
    std::string index, render, artifacts, scale = {}, gpu = {}, agreement = {}, motion = {},
                                          building = {}, change = {}, between = {},
                                          public_files = {};
};

/// The page in Markdown, and the charts that it shows by their paths from the folder of the page.
struct ResultsPage {
    std::string text;
    std::map<std::string, std::string> charts; ///< SVG
};

/// All parts, ten figures for users first; the same results give the same page.
/// @param read returns a file's text
ResultsPage whole_page(const ResultPaths& paths,
                       const std::function<std::string(const std::string&)>& read);

/// The part on the index, with the command that makes the page.
std::string results_page(const Results& results, const ResultPaths& paths);

} // namespace isochron::bench
