// The figure of an installation: floor plan and elevations with walls, eyes, trackers and data.
#pragma once

#include "app/config/config.h"
#include "app/config/config_problem.h"
#include "render/gl/image.h"

#include <vector>

namespace isochron::app {

/// Three views of one scale: from above with the front at the top, from the right, from behind; with
/// a grid in meters, and the problems in words. Walls are lit on the side that is to be looked at,
/// red where something is wrong and amber where something is odd.
/// @param problems of the configuration
render::Image room_plan(const Config& config, const std::vector<ConfigProblem>& problems);

} // namespace isochron::app
