// Which build on which machine a benchmark measures.
#pragma once

#include "app/bench/rows.h"

namespace isochron::app::bench {

/// This build, the processor it runs on, and today's date (UTC).
Header this_machine();

} // namespace isochron::app::bench
