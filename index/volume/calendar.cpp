// Counts the days of calendars.
#include "index/volume/calendar.h"

#include <array>
#include <utility>

namespace isochron::index {
namespace {

constexpr int kFirstYear = -9999, kLastYear = 99999;
/// The first Gregorian day of the standard calendar.
constexpr Date kReform{1582, 10, 15};
/// From the calendars' year 0 to 1970-01-01 of the Gregorian one.
constexpr std::int64_t kGregorianDays = 719528, kJulianDays = 719530;

bool is_leap(std::int64_t year, Calendar calendar) {
    switch (calendar) {
    case Calendar::all_leap: return true;
    case Calendar::julian: return year % 4 == 0;
    case Calendar::standard:
    case Calendar::gregorian: return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    case Calendar::noleap:
    case Calendar::days_360: break;
    }
    return false;
}

int days_in(int month, std::int64_t year, Calendar calendar) {
    constexpr std::array kDays{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    if (calendar == Calendar::days_360)
        return 30;
    return kDays[static_cast<std::size_t>(month - 1)] + (month == 2 && is_leap(year, calendar));
}

std::int64_t floored(std::int64_t a, std::int64_t b) {
    return a / b - (a % b < 0);
}

/// Days from January 1st of year 0 to January 1st of another year.
std::int64_t days_before(std::int64_t year, Calendar calendar) {
    // Leap years from 0 up to the year before, or, for years before 0, less than 0.
    const auto multiples = [&](std::int64_t of) { return floored(year - 1, of) + 1; };
    switch (calendar) {
    case Calendar::days_360: return 360 * year;
    case Calendar::noleap: return 365 * year;
    case Calendar::all_leap: return 366 * year;
    case Calendar::julian: return 365 * year + multiples(4) - kJulianDays;
    case Calendar::standard:
    case Calendar::gregorian: break;
    }
    return 365 * year + multiples(4) - multiples(100) + multiples(400) - kGregorianDays;
}

bool before_reform(const Date& date) {
    return std::pair(date.year, date.month * 100 + date.day) <
           std::pair(kReform.year, kReform.month * 100 + kReform.day);
}

} // namespace

std::optional<Calendar> calendar_of(std::string_view name) {
    constexpr std::array<std::pair<std::string_view, Calendar>, 12> kNames{{
        {"", Calendar::standard},
        {"standard", Calendar::standard},
        {"gregorian", Calendar::standard},
        {"proleptic_gregorian", Calendar::gregorian},
        {"julian", Calendar::julian},
        {"noleap", Calendar::noleap},
        {"365_day", Calendar::noleap},
        {"all_leap", Calendar::all_leap},
        {"366_day", Calendar::all_leap},
        {"360_day", Calendar::days_360},
        {"thirty_day_months", Calendar::days_360}, // a name of GFDL's FMS
        {"no_leap", Calendar::noleap},
    }};
    for (const auto& [known, calendar] : kNames)
        if (known == name)
            return calendar;
    return std::nullopt;
}

std::optional<std::int64_t> day_number(const Date& date, Calendar calendar) {
    if (calendar == Calendar::standard) {
        if (date.year < 1)
            return std::nullopt; // what year comes before 1, programs do not agree on
        const bool julian = before_reform(date);
        if (julian && date.year == kReform.year && date.month == kReform.month && date.day > 4)
            return std::nullopt;
        return day_number(date, julian ? Calendar::julian : Calendar::gregorian);
    }
    if (date.year < kFirstYear || date.year > kLastYear || date.month < 1 || date.month > 12 ||
        date.day < 1 || date.day > days_in(date.month, date.year, calendar))
        return std::nullopt;
    std::int64_t days = days_before(date.year, calendar) + date.day - 1;
    for (int month = 1; month < date.month; ++month)
        days += days_in(month, date.year, calendar);
    return days;
}

std::optional<Date> date_of(std::int64_t day, Calendar calendar) {
    if (calendar == Calendar::standard) {
        static const std::int64_t reform = *day_number(kReform, Calendar::gregorian);
        const auto date = date_of(day, day < reform ? Calendar::julian : Calendar::gregorian);
        return date && date->year > 0 ? date : std::nullopt;
    }
    if (day < days_before(kFirstYear, calendar) || day >= days_before(kLastYear + 1, calendar))
        return std::nullopt;
    std::int64_t year = kFirstYear;
    for (std::int64_t end = kLastYear + 1; end - year > 1;) {
        const std::int64_t middle = floored(year + end, 2);
        (days_before(middle, calendar) <= day ? year : end) = middle;
    }
    Date date{static_cast<int>(year), 1, 1};
    std::int64_t left = day - days_before(year, calendar);
    for (; left >= days_in(date.month, year, calendar); ++date.month)
        left -= days_in(date.month, year, calendar);
    date.day = static_cast<int>(left) + 1;
    return date;
}

} // namespace isochron::index
