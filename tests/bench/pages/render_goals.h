// The goals of rendering, compared with the measured figures.
#pragma once

#include "tests/bench/pages/render_rows.h"

#include <string>
#include <vector>

namespace isochron::bench {

/// A table in Markdown: every goal with its floor, the range of the figures of all rows that it
/// concerns, and the verdict on the worst of them.
std::string render_goals_table(const std::vector<RenderRow>& rows);

} // namespace isochron::bench
