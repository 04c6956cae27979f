// The goals of the index, compared with the measured figures.
#pragma once

#include "tests/bench/pages/rows.h"

#include <string>

namespace isochron::bench {

/// A table in Markdown: every goal with its floor, the range of the figures of all rows that it
/// concerns, and the verdict on the worst of them.
std::string goals_table(const Results& results);

} // namespace isochron::bench
