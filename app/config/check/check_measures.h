// Finds measures of a configuration that no room has: meters and millimeters, degrees and radians.
#pragma once

#include "app/config/config.h"
#include "app/config/config_problem.h"

#include <vector>

namespace isochron::app {

/// Warnings about viewers, planes, screens and calibrations that are unlikely to be meant.
std::vector<ConfigProblem> problems_of_measures(const Config& config);

} // namespace isochron::app
