// The build and the machine that a benchmark measures.
#pragma once

#include "tests/bench/rows/rows.h"

namespace isochron::bench {

/// This build, the processor it runs on, and today's date (UTC).
Header this_machine();

} // namespace isochron::bench
