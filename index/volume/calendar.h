// Dates in the calendars of the CF conventions.
//
// https://cfconventions.org/Data/cf-conventions/cf-conventions-1.11/cf-conventions.html#calendar
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace isochron::index {

/// `standard` is Julian up to 1582-10-04 and Gregorian from the next day, 1582-10-15, on; it begins
/// with the year 1.
enum class Calendar : std::uint8_t { standard, gregorian, julian, noleap, all_leap, days_360 };

struct Date {
    int year = 1970;
    int month = 1, day = 1; ///< counted from 1
    bool operator==(const Date&) const = default;
};

/// What stands first in dates whose year is last: 31-01-2020 or 01-31-2020.
enum class DayMonth : std::uint8_t { day_first, month_first };
/// `dmy` or `mdy`
constexpr std::string_view word_of(DayMonth order) {
    return order == DayMonth::day_first ? "dmy" : "mdy";
}
/// @return none: it is neither of these words
constexpr std::optional<DayMonth> day_month_of(std::string_view word) {
    for (const DayMonth order : {DayMonth::day_first, DayMonth::month_first})
        if (word == word_of(order))
            return order;
    return std::nullopt;
}

/// By its name in CF or FMS, in lower case: `standard` (also `gregorian` and no name), `noleap`,
/// `360_day`, `thirty_day_months` and so on. `Calendar::gregorian` is `proleptic_gregorian`. @return none for other names
std::optional<Calendar> calendar_of(std::string_view name);

/// Days from a fixed date, the same for standard, gregorian and julian (1970-01-01, Gregorian).
/// @return none when the calendar has no such date, or its year is beyond -9999 to 99999
std::optional<std::int64_t> day_number(const Date& date, Calendar calendar);

/// The date of a day number. @return none when its year is beyond -9999 to 99999
std::optional<Date> date_of(std::int64_t day, Calendar calendar);

} // namespace isochron::index
