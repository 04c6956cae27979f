// The steps that playing shows next, for the worker that finds their cells ahead.
#pragma once

#include "index/extraction/recent_extractions.h"
#include "index/volume/instant.h"
#include "interaction/settings.h"

#include <optional>
#include <span>

namespace isochron::app {

/// What playing shows after an instant; empty if it shows only one step.
/// @param now what is shown @param settings range and way of playing
/// @param times of the steps that can be shown
std::optional<index::StepsAhead> steps_ahead(index::Instant now,
                                             const interaction::Settings& settings,
                                             std::span<const double> times);

} // namespace isochron::app
