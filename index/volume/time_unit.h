// Converts physical times between units, with or without a reference date, and writes them for
// people.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::index {

/// Converts times from the unit `given` to the unit `wanted`. Units are `s`, `ms`, `hours`, ... or,
/// after the CF conventions, `hours since 1970-01-01 06:00`, with a calendar in brackets if it is
/// not the usual one: `days since 2000-01-01 (360_day)`. Months and years are those of the calendar:
/// 1.5 `months since 1979-01-01` is the middle of February.
/// @return none when it is impossible: unknown units, different calendars, only one unit with a
///         date, months or years wanted of other units where their length varies
std::optional<std::vector<double>> times_in(const std::string& wanted, const std::string& given,
                                            std::vector<double> times);

/// A unit with the calendar (an attribute of CF) behind it in brackets, if it makes a difference.
std::string with_calendar(const std::string& unit, const std::string& calendar);

/// The date of a step where the unit has a reference date, else its time and the unit:
/// `2009-09-09 17:00`, `2000-02-30 (360_day)`, `0.25 s`. The text is as short as it can be while it
/// differs from the texts of the steps before and after; dates are rounded to a millisecond.
/// @param times of all steps, increasing
std::string time_text(std::span<const double> times, std::size_t step, const std::string& unit);

/// Whether a unit is months or years of differing lengths.
bool counts_months(const std::string& unit);

/// Whether `time_text` gives dates.
bool has_dates(std::span<const double> times, const std::string& unit);

} // namespace isochron::index
