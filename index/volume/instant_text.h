// An instant for people, and its physical time.
#pragma once

#include "index/volume/instant.h"

#include <span>
#include <string>

namespace isochron::index {

/// @param times of all steps, increasing; not empty
double time_at(std::span<const double> times, Instant at);

/// `3`, or between two steps `3 + 77/65536`.
std::string number_text(Instant at);

/// As `time_text` (index/volume/time_unit.h) of a step, also between two steps.
std::string instant_text(std::span<const double> times, Instant at, const std::string& unit);

} // namespace isochron::index
