// Reads dates that are text.
#include "index/readers/formats/stated/axis_dates.h"

#include "index/lower_case.h"
#include "index/volume/calendar.h"
#include "index/volume/time_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace isochron::index {
namespace {

/// [s] since 1970; none where it is no date.
std::optional<double> seconds_of(const std::string& text) {
    int year = 0, month = 0, day = 0, hour = 0, minute = 0;
    double second = 0;
    char between = 0;
    if (std::sscanf(text.c_str(), "%5d-%2d-%2d%c%2d:%2d:%6lf", &year, &month, &day, &between, &hour,
                    &minute, &second) != 7 ||
        std::string("_T ").find(between) == std::string::npos || hour < 0 || hour > 23 ||
        minute < 0 || minute > 59 || !(second >= 0 && second < 61))
        return std::nullopt;
    const auto days = day_number({year, month, day}, Calendar::gregorian);
    if (!days)
        return std::nullopt;
    return static_cast<double>(*days * 86400 + hour * 3600 + minute * 60) + second;
}

/// What the digits before the point of such a number are.
struct AbsoluteUnit {
    const char* begin; ///< how the name of the unit begins
    int months, days;  ///< whether there are digits of it
};
constexpr std::array<AbsoluteUnit, 3> kAbsoluteUnits{
    {{"day as %y%m%d", 1, 1}, {"month as %y%m", 1, 0}, {"year as %y", 0, 0}}};

const AbsoluteUnit* absolute_unit(const std::string& unit) {
    const std::string lower = lower_case(unit);
    const auto known = std::ranges::find_if(
        kAbsoluteUnits, [&](const AbsoluteUnit& each) { return lower.starts_with(each.begin); });
    return known == kAbsoluteUnits.end() ? nullptr : known;
}

/// Days from a fixed date; the fraction is one of the day, the month or the year.
std::optional<double> days_of(double number, const AbsoluteUnit& unit, Calendar calendar) {
    constexpr double kMost = 1e9;
    if (!(std::abs(number) < kMost))
        return std::nullopt;
    const double whole = std::floor(number), fraction = number - whole;
    auto digits = static_cast<long long>(whole);
    Date date, next;
    if (unit.days) {
        date.day = static_cast<int>(digits % 100);
        digits /= 100;
    }
    if (unit.months) {
        date.month = static_cast<int>(digits % 100);
        digits /= 100;
    }
    date.year = static_cast<int>(digits);
    const auto begin = day_number(date, calendar);
    if (!begin)
        return std::nullopt;
    if (unit.days)
        return static_cast<double>(*begin) + fraction;
    next = date;
    if (!unit.months || ++next.month == 13) {
        next.month = 1;
        ++next.year;
    }
    const auto end = day_number(next, calendar);
    return end ? std::optional(static_cast<double>(*begin) +
                               fraction * static_cast<double>(*end - *begin))
               : std::nullopt;
}

} // namespace

bool says_dates(const std::string& unit) {
    return absolute_unit(unit) != nullptr;
}

void place_absolute_dates(std::vector<double> numbers, const std::string& unit,
                          const std::string& calendar, SeriesInfo& info) {
    const auto known = calendar_of(lower_case(calendar));
    std::vector<double> days;
    for (const double number : numbers)
        if (const auto day = known ? days_of(number, *absolute_unit(unit), *known) : std::nullopt)
            days.push_back(*day);
    if (days.size() != numbers.size() || days.empty()) {
        info.times = std::move(numbers);
        info.time_unit = unit;
        info.notes.push_back(fmt::format("times in \"{}\" of the calendar \"{}\" are no dates: "
                                         "they are taken for numbers",
                                         unit, calendar));
        return;
    }
    const double begin = std::floor(days.front());
    const auto first = date_of(static_cast<std::int64_t>(begin), *known);
    for (double& day : days)
        day -= begin;
    info.times = std::move(days);
    info.time_unit = with_calendar(
        fmt::format("days since {:04}-{:02}-{:02}", first->year, first->month, first->day),
        calendar);
}

void place_text_dates(const std::string& name, const std::vector<std::string>& dates,
                      SeriesInfo& info) {
    std::vector<double> times;
    for (std::size_t step = 0; step < dates.size(); ++step) {
        const auto seconds = seconds_of(dates[step]);
        if (!seconds) {
            info.notes.push_back(
                fmt::format("{} of step {} is no date: steps have no times", name, step));
            return;
        }
        times.push_back(*seconds);
    }
    if (times.empty())
        return;
    std::string first = dates.front().substr(0, 19);
    const double begin = *seconds_of(first);
    for (double& at : times)
        at -= begin;
    std::ranges::replace(first, '_', ' ');
    std::ranges::replace(first, 'T', ' ');
    info.times = std::move(times);
    info.time_unit = "seconds since " + first;
}

} // namespace isochron::index
