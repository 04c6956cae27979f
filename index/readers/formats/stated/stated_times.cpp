// Makes times and dates of what files state.
#include "index/readers/formats/stated/stated_times.h"

#include "index/lower_case.h"
#include "index/readers/formats/series/dated_name.h"
#include "index/volume/time_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string_view>
#include <utility>

namespace isochron::index {
namespace {

/// [s] since 1970-01-01 of a date as ISO 8601 has it, alone or with a time of day, a fraction of its
/// seconds and a zone: `2005-08-28`, `2005-08-28_12:00:00.5`, `2005-08-28T12:00+02:00`; none: it is none
std::optional<double> seconds_of(const std::string& text) {
    int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0, end = 0;
    if (std::sscanf(text.c_str(), "%5d-%2d-%2d%n", &year, &month, &day, &end) != 3 || end < 8)
        return std::nullopt;
    const auto days = day_number({year, month, day}, Calendar::gregorian);
    std::string_view rest = std::string_view(text).substr(static_cast<std::size_t>(end));
    const auto pass = [&](int count) { rest.remove_prefix(static_cast<std::size_t>(count)); };
    double fraction = 0;
    if (!rest.empty() && std::string_view("_T ").find(rest.front()) != rest.npos) {
        pass(1);
        if (std::sscanf(rest.data(), "%2d:%2d%n", &hour, &minute, &end) != 2)
            return std::nullopt;
        pass(end);
        if (std::sscanf(rest.data(), ":%2d%n", &second, &end) == 1)
            pass(end);
        if (rest.starts_with('.')) {
            const auto [behind, failure] = std::from_chars(rest.data(), rest.data() + rest.size(),
                                                           fraction, std::chars_format::fixed);
            pass(failure == std::errc{} ? static_cast<int>(behind - rest.data()) : 1);
        }
    }
    int zone_hour = 0, zone_minute = 0;
    if (rest.starts_with('+') || rest.starts_with('-')) {
        const int sign = rest.front() == '-' ? -1 : 1;
        if (std::sscanf(rest.data() + 1, "%2d:%2d%n", &zone_hour, &zone_minute, &end) != 2 &&
            std::sscanf(rest.data() + 1, "%2d%2d%n", &zone_hour, &zone_minute, &end) != 2)
            return std::nullopt;
        pass(end + 1);
        zone_hour *= sign;
        zone_minute *= sign;
    } else if (rest == "Z") {
        pass(1);
    }
    if (!rest.empty() || !days || hour < 0 || hour > 23 || minute < 0 || minute > 59 ||
        second < 0 || second > 60 || std::abs(zone_hour) > 14 || std::abs(zone_minute) > 59)
        return std::nullopt;
    const double seconds = static_cast<double>(*days * 86400 + (hour - zone_hour) * 3600 +
                                               (minute - zone_minute) * 60 + second) +
                           fraction;
    const auto of_calendar =
        date_of(static_cast<std::int64_t>(std::floor(seconds / 86400)), Calendar::gregorian);
    return of_calendar ? std::optional(seconds) : std::nullopt;
}

/// Whether a text stands for no date.
bool is_no_date(const std::string& text) {
    return text.empty() || text == "NaT";
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

/// Days since the first day of numbers that are dates; none where one is no date.
std::optional<StatedTimes> days_of(const StatedTimes& stated, const AbsoluteUnit& unit) {
    const auto calendar = calendar_of(lower_case(stated.calendar));
    StatedTimes days = stated;
    for (double& number : days.values) {
        const auto day = calendar ? days_of(number, unit, *calendar) : std::nullopt;
        if (!day)
            return std::nullopt;
        number = *day;
    }
    const double begin = std::floor(days.values.front());
    const auto first = date_of(static_cast<std::int64_t>(begin), *calendar);
    for (double& day : days.values)
        day -= begin;
    days.unit = fmt::format("days since {:04}-{:02}-{:02}", first->year, first->month, first->day);
    return days;
}

/// Whether a number stands for no time. An ordinary number that a file names does so only where the
/// times could not ascend with it.
bool is_missing(double value, std::span<const double> named, bool ascend) {
    constexpr double kOrdinary = 1e15, kFillOfReals = 9.969209968386869e36,
                     kFillOfI32 = -2147483647, kFillOfI64 = -9.2233720368547758e18;
    const auto is = [&](double missing) {
        const bool ordinary = std::abs(missing) < kOrdinary;
        return value == missing ? !(ordinary && ascend)
                                : !ordinary && std::abs(value - missing) < 1e-6 * std::abs(missing);
    };
    return !std::isfinite(value) || value == kFillOfI32 || is(kFillOfReals) || is(kFillOfI64) ||
           std::ranges::any_of(named, is);
}

/// Leaves out the last steps if their times are missing; makes NaN of other missing times.
void drop_missing(StatedTimes& stated, SeriesInfo& info) {
    std::vector<double>& values = stated.values;
    const bool ascend = std::ranges::adjacent_find(
                            values, [](double a, double b) { return !(a < b); }) == values.end();
    for (double& value : values)
        if (is_missing(value, stated.missing, ascend))
            value = std::numeric_limits<double>::quiet_NaN();
    const std::size_t all = values.size();
    while (!values.empty() && std::isnan(values.back()))
        values.pop_back();
    if (all == 0)
        return;
    if (values.empty())
        info.notes.push_back(
            fmt::format("{} holds fill values alone: steps have no times", stated.name));
    else if (const std::size_t first = values.size(), last = all - 1; first <= last)
        info.notes.push_back(
            fmt::format("{} no time (a fill value in {}), as where a run was stopped: left out",
                        first == last ? fmt::format("step {} has", first)
                                      : fmt::format("steps {} to {} have", first, last),
                        stated.name));
}

/// `2005-08-28`, the day in which so many seconds after 1970-01-01 are.
std::string written_day(double seconds) {
    constexpr double kDay = 86400;
    const auto date =
        date_of(static_cast<std::int64_t>(std::floor(seconds / kDay)), Calendar::gregorian);
    return fmt::format("{:04}-{:02}-{:02}", date->year, date->month, date->day);
}

/// `2005-08-28`, and the time of day where it is not midnight; whole seconds.
std::string written(double seconds) {
    const auto of_day =
        static_cast<int>(seconds - std::floor(seconds / 86400) * 86400); // 0 to 86399
    return written_day(seconds) + (of_day == 0 ? ""
                                               : fmt::format(" {:02}:{:02}:{:02}", of_day / 3600,
                                                             of_day / 60 % 60, of_day % 60));
}

/// The length of the date that a text begins with, whose year of four digits is last.
std::size_t length_with_year_last(std::string_view text) {
    std::size_t digits = 0, at = 0;
    for (; at < text.size() && digits < 4; ++at)
        digits = text[at] >= '0' && text[at] <= '9' ? digits + 1 : 0;
    return at;
}

std::string open_dates(const std::string& name, const std::string& date) {
    return fmt::format("{} {} may be day-month-year or month-day-year (--dates dmy, --dates mdy)",
                       name, date);
}

/// Writes a reference date whose year is last as ISO 8601 has it, if it is told what is its day. The
/// time of day and the zone behind it stay.
void write_reference_anew(StatedTimes& stated, SeriesInfo& info, std::optional<DayMonth> said) {
    constexpr std::string_view kSince = " since ";
    const std::size_t since = lower_case(stated.unit).find(kSince);
    if (since == stated.unit.npos)
        return;
    const std::string reference = stated.unit.substr(since + kSince.size());
    if (reference.find_first_not_of("0123456789") > 2) // the year is first, or it is a number
        return;
    const std::size_t length = length_with_year_last(reference);
    const TextDates read = dates_of_texts({reference.substr(0, length)}, said);
    if (read.open)
        info.notes.push_back(open_dates("the reference date", reference));
    if (read.seconds.empty())
        return;
    info.notes.push_back(
        fmt::format("the reference date {} is read as {}", reference, name_of(read.order)));
    std::string behind = reference.substr(length);
    if (behind.find_first_not_of(' ') == behind.npos)
        behind = " 00:00:00";
    else if (behind.front() == '_' || behind.front() == '-') // as dates in names have it
        behind.front() = ' ';
    stated.unit.replace(since + kSince.size(), reference.size(),
                        written_day(read.seconds.front()) + behind);
}

} // namespace

void place_times(StatedTimes stated, SeriesInfo& info, std::optional<DayMonth> dates) {
    drop_missing(stated, info);
    if (stated.values.empty())
        return;
    write_reference_anew(stated, info, dates);
    const AbsoluteUnit* const absolute = absolute_unit(stated.unit);
    const auto days = absolute ? days_of(stated, *absolute) : std::nullopt;
    if (days)
        stated = *days;
    info.times = std::move(stated.values);
    info.time_unit = with_calendar(stated.unit, stated.calendar);
    const std::size_t since = lower_case(stated.unit).find(" since ");
    const bool says_dates =
        absolute || (since != stated.unit.npos &&
                     stated.unit.find_first_of("0123456789", since) != stated.unit.npos);
    if (says_dates && !has_dates(info.times, info.time_unit))
        info.notes.push_back(fmt::format("times in \"{}\" of the calendar \"{}\" are no dates: "
                                         "they are taken for numbers",
                                         stated.unit, stated.calendar));
    else if (counts_months(info.time_unit))
        info.notes.push_back(fmt::format("times in \"{}\" are counted in months of the calendar, "
                                         "not in parts of a mean year",
                                         stated.unit));
}

bool are_dates(std::span<const std::string> texts) {
    std::vector<std::string> dates(texts.begin(), texts.end());
    std::erase_if(dates, is_no_date);
    if (std::ranges::all_of(dates, [](const auto& date) { return seconds_of(date).has_value(); }))
        return !dates.empty();
    const TextDates read = dates_of_texts(dates, {});
    return (read.open || !read.seconds.empty()) &&
           std::ranges::all_of(dates, [](const std::string& date) {
               return date.find_first_of("0123456789") == 0;
           });
}

void place_dates(std::span<const std::string> dates, const std::string& name, SeriesInfo& info,
                 std::optional<DayMonth> said) {
    StatedTimes stated{.name = name};
    for (const std::string& date : dates)
        if (is_no_date(date))
            stated.values.push_back(std::numeric_limits<double>::quiet_NaN());
        else if (const auto seconds = seconds_of(date))
            stated.values.push_back(*seconds);
    if (stated.values.size() != dates.size()) {
        const auto none = std::ranges::find_if(
            dates, [](const std::string& date) { return !is_no_date(date) && !seconds_of(date); });
        std::vector<std::string> there(dates.begin(), dates.end());
        std::erase_if(there, is_no_date);
        const TextDates read = dates_of_texts(there, said);
        if (read.seconds.empty()) {
            info.notes.push_back(read.open
                                     ? open_dates(name, there.front()) + ": steps have no times"
                                     : fmt::format("{} of step {} is no date: steps have no "
                                                   "times",
                                                   name, none - dates.begin()));
            return;
        }
        if (read.year_last)
            info.notes.push_back(
                fmt::format("{}: dates are read as {}", name, name_of(read.order)));
        stated.values.clear();
        for (auto next = read.seconds.begin(); const std::string& date : dates)
            stated.values.push_back(is_no_date(date) ? std::numeric_limits<double>::quiet_NaN()
                                                     : *next++);
    }
    const auto first = std::ranges::find_if(stated.values, [](double at) { return at == at; });
    const double begin = first == stated.values.end() ? 0 : std::floor(*first);
    stated.unit = "seconds since " + written(begin);
    for (double& at : stated.values)
        at -= begin;
    place_times(std::move(stated), info);
}

} // namespace isochron::index
