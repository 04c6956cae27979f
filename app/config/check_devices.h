// Finds the problems in the devices of a configuration.
#pragma once

#include "app/config/config.h"
#include "app/config/config_problem.h"

#include <vector>

namespace isochron::app {

/// Heads without a tracker, ports that two trackers listen on, sources that two devices use, and
/// trackers that this program was built without.
std::vector<ConfigProblem> problems_of_devices(const Config& config);

} // namespace isochron::app
