// Units of physical time, with or without the date from which they count.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace isochron::index {

/// Times given in one unit, in another. Units are `s`, `ms`, `hours`, ... or, after the CF
/// conventions, `hours since 1970-01-01 06:00`, with a calendar in brackets where it is not the
/// usual one: `days since 2000-01-01 (360_day)`.
/// @return none where that cannot be known: unknown units, other calendars, a date beside none,
///         months and years, which have no length, and dates before 1583, whose calendar is unsure
std::optional<std::vector<double>> times_in(const std::string& wanted, const std::string& given,
                                            std::vector<double> times);

} // namespace isochron::index
