// Parses units of physical time, and writes times for people.
#include "index/volume/time_unit.h"

#include "index/lower_case.h"
#include "index/volume/calendar.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <regex>
#include <string_view>

namespace isochron::index {
namespace {

constexpr double kDay = 86400; // s

struct TimeUnit {
    double seconds = 0; ///< length of one unit; 0: a unit of months
    int months = 0;     ///< months of a calendar in which their lengths differ
    bool dated = false;
    Date date = {};
    std::int64_t day = 0; ///< number of the reference date's day
    double clock = 0;     ///< [s] of the reference date since its midnight
    Calendar calendar = Calendar::standard;
};

struct UnitName {
    std::string_view names; ///< each between bars
    double seconds;
};
constexpr std::array<UnitName, 8> kUnits{{
    {"|common_year|common_years|", 365 * kDay},
    {"|week|weeks|", 7 * kDay},
    {"|d|day|days|", kDay},
    {"|h|hr|hrs|hour|hours|", 3600},
    {"|min|mins|minute|minutes|", 60},
    {"|s|sec|secs|second|seconds|", 1},
    {"|ms|msec|msecs|millisecond|milliseconds|", 1e-3},
    {"|us|usec|usecs|microsecond|microseconds|", 1e-6},
}};

std::optional<double> seconds_of(const std::string& name) {
    for (const UnitName& unit : kUnits)
        if (unit.names.find("|" + name + "|") != unit.names.npos)
            return unit.seconds;
    return std::nullopt;
}

/// Months in a unit; 0: it is shorter.
int months_of(const std::string& name) {
    constexpr std::string_view kMonths = "|month|months|mon|mons|", kYears = "|year|years|yr|yrs|";
    const std::string framed = "|" + name + "|";
    return kMonths.find(framed) != kMonths.npos ? 1 : kYears.find(framed) != kYears.npos ? 12 : 0;
}

/// Months and years are as long as others only where all of them are equally long.
std::optional<double> seconds_of(int months, Calendar calendar) {
    switch (calendar) {
    case Calendar::days_360: return months * 30 * kDay;
    case Calendar::noleap: return months == 12 ? std::optional(365 * kDay) : std::nullopt;
    case Calendar::all_leap: return months == 12 ? std::optional(366 * kDay) : std::nullopt;
    default: return std::nullopt;
    }
}

double number(const std::ssub_match& digits) {
    return digits.matched ? std::strtod(digits.str().c_str(), nullptr) : 0.0;
}

std::optional<TimeUnit> time_unit(const std::string& text) {
    if (const auto seconds = seconds_of(text))
        return TimeUnit{.seconds = *seconds};
    // unit, year, month, day, hour, minute, second, zone's sign, hour and minute, calendar
    static const std::regex kDated(
        R"((\w+) +since +(-?\d{1,5})-(\d{1,2})-(\d{1,2})(?:[T ]+(\d{1,2})(?::(\d{1,2})(?::(\d{1,2}(?:\.\d*)?))?)?)?)"
        R"( *(?:Z|UTC|GMT)?(?: *([+-])(\d{1,2})(?::?(\d{2}))?)?(?: \((\w+)\))?)",
        std::regex::icase);
    constexpr std::size_t kLongest = 200;
    std::smatch part;
    if (text.size() > kLongest || !std::regex_match(text, part, kDated))
        return std::nullopt;
    auto calendar = calendar_of(lower_case(part[11].str()));
    const Date date{static_cast<int>(number(part[2])), static_cast<int>(number(part[3])),
                    static_cast<int>(number(part[4]))};
    const auto day = calendar ? day_number(date, *calendar) : std::nullopt;
    const std::string name = lower_case(part[1].str());
    const int months = months_of(name);
    const auto seconds =
        !calendar || months == 0 ? seconds_of(name) : seconds_of(months, *calendar);
    if ((!seconds && months == 0) || !day || number(part[5]) > 24 || number(part[6]) > 60 ||
        number(part[7]) > 61)
        return std::nullopt;
    constexpr int kFirstSame = 1583;
    if (calendar == Calendar::gregorian && date.year >= kFirstSame)
        calendar = Calendar::standard;
    const double zone =
        (part[8] == "-" ? -1 : 1) * (number(part[9]) * 3600 + number(part[10]) * 60);
    const double clock = number(part[5]) * 3600 + number(part[6]) * 60 + number(part[7]);
    return TimeUnit{.seconds = seconds.value_or(0),
                    .months = seconds ? 0 : months,
                    .dated = true,
                    .date = date,
                    .day = *day,
                    .clock = clock - zone,
                    .calendar = *calendar};
}

std::string_view name_of(Calendar calendar) {
    switch (calendar) {
    case Calendar::standard: break;
    case Calendar::gregorian: return " (proleptic_gregorian)";
    case Calendar::julian: return " (julian)";
    case Calendar::noleap: return " (noleap)";
    case Calendar::all_leap: return " (all_leap)";
    case Calendar::days_360: return " (360_day)";
    }
    return "";
}

/// A moment of a calendar.
struct Moment {
    Date date;
    int milliseconds = 0; ///< since midnight
};

/// A time since midnight of some day.
struct DayTime {
    std::int64_t day = 0;
    double seconds = 0; ///< may be more than a day, or below 0
};

/// The day of a date so many months later: its number, or that of the month's last day where the
/// month is shorter.
std::optional<std::int64_t> months_later(Date date, std::int64_t months, Calendar calendar) {
    const std::int64_t month = std::int64_t{date.year} * 12 + date.month - 1 + months;
    const std::int64_t year = month / 12 - (month % 12 < 0);
    date.year = static_cast<int>(year);
    date.month = static_cast<int>(month - year * 12) + 1;
    auto day = day_number(date, calendar);
    for (constexpr int kShortest = 28; !day && date.day > kShortest; --date.day)
        day = day_number({date.year, date.month, date.day - 1}, calendar);
    return day;
}

/// Where a time is: so many whole units, and a part of the next, behind the reference date.
std::optional<DayTime> day_time(double time, const TimeUnit& unit) {
    constexpr double kMostDays = 1e8, kMostMonths = 2e6;
    if (unit.months == 0) {
        const double seconds = time * unit.seconds, days = std::floor(seconds / kDay);
        if (!(std::abs(days) < kMostDays))
            return std::nullopt;
        // The day is taken off first: what is left has more digits than the sum.
        return DayTime{unit.day + static_cast<std::int64_t>(days),
                       seconds - days * kDay + unit.clock};
    }
    const double units = std::floor(time);
    if (!(std::abs(units) * unit.months < kMostMonths))
        return std::nullopt;
    const std::int64_t months = static_cast<std::int64_t>(units) * unit.months;
    const auto begin = months_later(unit.date, months, unit.calendar),
               end = months_later(unit.date, months + unit.months, unit.calendar);
    if (!begin || !end)
        return std::nullopt;
    return DayTime{*begin, (time - units) * static_cast<double>(*end - *begin) * kDay + unit.clock};
}

std::optional<Moment> moment_of(double time, const TimeUnit& unit) {
    constexpr std::int64_t kDayMs = 86'400'000;
    const auto found = day_time(time, unit);
    if (!found)
        return std::nullopt;
    const std::int64_t ms = std::llround(found->seconds * 1000);
    const std::int64_t more = ms / kDayMs - (ms % kDayMs < 0);
    const auto date = date_of(found->day + more, unit.calendar);
    if (!date)
        return std::nullopt;
    return Moment{*date, static_cast<int>(ms - more * kDayMs)};
}

/// Parts of a time of day that a moment needs: 0 at midnight, 1 for hour and minute, 2 with seconds,
/// 3 with milliseconds.
int parts_of(const Moment& moment) {
    return moment.milliseconds % 1000     ? 3
           : moment.milliseconds % 60'000 ? 2
           : moment.milliseconds          ? 1
                                          : 0;
}

std::string text_of(const Moment& moment, int parts) {
    const int ms = moment.milliseconds;
    std::string text =
        fmt::format("{:04}-{:02}-{:02}", moment.date.year, moment.date.month, moment.date.day);
    if (parts > 0)
        text += fmt::format(" {:02}:{:02}", ms / 3'600'000, ms / 60'000 % 60);
    if (parts > 1)
        text += fmt::format(":{:02}", ms / 1000 % 60);
    if (parts > 2)
        text += fmt::format(".{:03}", ms % 1000);
    return text;
}

/// The times of the step before, the step itself and the step after, as far as they exist.
std::span<const double> around(std::span<const double> times, std::size_t step) {
    const std::size_t first = step > 0 ? step - 1 : 0;
    return times.subspan(first, std::min(step + 2, times.size()) - first);
}

std::optional<std::string> date_text(std::span<const double> times, std::size_t step,
                                     const std::string& unit) {
    const auto known = time_unit(unit);
    if (!known || !known->dated)
        return std::nullopt;
    int parts = 0;
    for (const double time : around(times, step)) {
        const auto moment = moment_of(time, *known);
        if (!moment)
            return std::nullopt;
        parts = std::max(parts, parts_of(*moment));
    }
    return text_of(*moment_of(times[step], *known), parts) + std::string(name_of(known->calendar));
}

} // namespace

std::optional<std::vector<double>> times_in(const std::string& wanted, const std::string& given,
                                            std::vector<double> times) {
    if (wanted == given)
        return times;
    const auto to = time_unit(wanted), from = time_unit(given);
    if (!to || !from || to->dated != from->dated || to->calendar != from->calendar)
        return std::nullopt;
    if (to->months != 0) { // only from months that begin at the same moment of theirs
        if (from->months == 0 || from->date.day != to->date.day || from->clock != to->clock)
            return std::nullopt;
        const int between =
            (from->date.year - to->date.year) * 12 + from->date.month - to->date.month;
        for (double& time : times)
            time = (time * from->months + between) / to->months;
        return times;
    }
    const double between =
        static_cast<double>(from->day - to->day) * kDay + (from->clock - to->clock);
    for (double& time : times) {
        if (from->months == 0) {
            time = (time * from->seconds + between) / to->seconds;
            continue;
        }
        const auto found = day_time(time, *from);
        if (!found)
            return std::nullopt;
        time = (static_cast<double>(found->day - to->day) * kDay + found->seconds - to->clock) /
               to->seconds;
    }
    return times;
}

std::string with_calendar(const std::string& unit, const std::string& calendar) {
    const std::string name = lower_case(calendar);
    const std::string with = fmt::format("{} ({})", unit, name);
    const auto known = time_unit(with);
    const bool usual =
        known ? known->calendar == Calendar::standard
              : calendar_of(name) == Calendar::standard || calendar_of(name) == Calendar::gregorian;
    return usual || name.empty() ? unit : with;
}

std::string time_text(std::span<const double> times, std::size_t step, const std::string& unit) {
    if (auto date = date_text(times, step, unit))
        return *date;
    constexpr int kFewest = 6, kMost = 17; // digits
    std::string text;
    for (int digits = kFewest; digits <= kMost; ++digits) {
        text = fmt::format("{:.{}g}", times[step], digits);
        int same = 0;
        for (const double time : around(times, step))
            same += fmt::format("{:.{}g}", time, digits) == text;
        if (same <= 1)
            break;
    }
    return unit.empty() ? text : fmt::format("{} {}", text, unit);
}

bool counts_months(const std::string& unit) {
    const auto known = time_unit(unit);
    return known && known->months > 0;
}

bool has_dates(std::span<const double> times, const std::string& unit) {
    return !times.empty() && date_text(times, 0, unit) && date_text(times, times.size() - 1, unit);
}

} // namespace isochron::index
