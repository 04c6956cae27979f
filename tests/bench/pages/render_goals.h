// What rendering is to reach, held against what was measured.
#pragma once

#include "tests/bench/pages/render_rows.h"

#include <string>
#include <vector>

namespace isochron::bench {

/// A table in Markdown: every goal with its floor, the figures of all rows that it speaks of, and
/// what the worst of them amounts to.
std::string render_goals_table(const std::vector<RenderRow>& rows);

} // namespace isochron::bench
