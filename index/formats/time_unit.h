// Converts physical times between units, with or without a reference date.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace isochron::index {

/// Converts times from the unit `given` to the unit `wanted`. Units are `s`, `ms`, `hours`, ... or,
/// after the CF conventions, `hours since 1970-01-01 06:00`, with a calendar in brackets if it is
/// not the usual one: `days since 2000-01-01 (360_day)`.
/// @return none when it is impossible: unknown units, different calendars, only one unit with a
///         date, months and years, whose length varies, and dates before 1583, whose calendar is
///         uncertain
std::optional<std::vector<double>> times_in(const std::string& wanted, const std::string& given,
                                            std::vector<double> times);

} // namespace isochron::index
