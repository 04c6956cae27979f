// The physical time of a moment, as a number and for people.
#pragma once

#include "index/volume/instant.h"

#include <span>
#include <string>

namespace isochron::index {

/// @param times of all steps, increasing; not empty
double time_at(std::span<const double> times, Instant at);

/// The time as `time_text` (index/volume/time_unit.h) writes it, also between two steps.
std::string instant_text(std::span<const double> times, Instant at, const std::string& unit);

} // namespace isochron::index
