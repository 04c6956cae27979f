// What is wrong with the devices of a configuration.
#pragma once

#include "app/config/config.h"
#include "app/config/config_problem.h"

#include <vector>

namespace isochron::app {

/// Heads that nobody tracks, addresses that two trackers ask for, things that two devices are made
/// of, and trackers that this program was built without.
std::vector<ConfigProblem> problems_of_devices(const Config& config);

} // namespace isochron::app
