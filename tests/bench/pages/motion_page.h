// The part of the page of results on the picture in motion.
#pragma once

#include "tests/bench/motion/rows.h"

#include <string>

namespace isochron::bench {

/// Markdown that follows the other parts; the same results give the same text.
/// @param source name of the results' file on the page
/// @param sheet name of the picture with all motions, from the page's folder; empty: none
std::string motion_section(const MotionResults& results, const std::string& source,
                           const std::string& sheet);

/// Every goal with its floor, the range of the figures that it concerns, and the verdict on the
/// worst of them.
std::string motion_goals_table(const std::vector<MotionRow>& rows);

} // namespace isochron::bench
