// What the index is to reach, held against what was measured.
#pragma once

#include "tests/bench/pages/rows.h"

#include <string>

namespace isochron::bench {

/// A table in Markdown: every goal with its floor, the figures of all rows that it speaks of, and
/// what the worst of them amounts to.
std::string goals_table(const Results& results);

} // namespace isochron::bench
