// Parses units of physical time, and counts the days of calendars.
#include "index/formats/time_unit.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <regex>
#include <string_view>

namespace isochron::index {
namespace {

struct TimeUnit {
    double seconds = 0; ///< of one unit
    bool dated = false;
    double from = 0; ///< [s] to the reference date from a fixed date of the calendar
    std::string calendar;
};

struct UnitName {
    std::string_view names; ///< each between bars
    double seconds;
};
constexpr std::array<UnitName, 6> kUnits{{
    {"|d|day|days|", 86400},
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

/// Days to a date from a fixed date of the same calendar; none for an unknown calendar.
std::optional<double> days_to(int year, unsigned month, unsigned day, const std::string& calendar) {
    constexpr std::array<int, 13> kBefore{0,   31,  59,  90,  120, 151, 181,
                                          212, 243, 273, 304, 334, 365};
    if (month < 1 || month > 12 || day < 1 || day > 31)
        return std::nullopt;
    const int in_year = kBefore[month - 1] + static_cast<int>(day) - 1;
    if (calendar == "360_day")
        return 360.0 * year + 30.0 * (month - 1) + day - 1;
    if (calendar == "noleap" || calendar == "365_day")
        return 365.0 * year + in_year;
    if (calendar == "all_leap" || calendar == "366_day")
        return 366.0 * year + in_year + (month > 2 ? 1 : 0);
    constexpr int kFirstSure = 1583; // the Gregorian calendar began in the year before
    if (!calendar.empty() || year < kFirstSure || year > 32767)
        return std::nullopt;
    const std::chrono::sys_days date =
        std::chrono::year(year) / std::chrono::month(month) / std::chrono::day(day);
    return static_cast<double>(date.time_since_epoch().count());
}

double number(const std::ssub_match& digits) {
    return digits.matched ? std::strtod(digits.str().c_str(), nullptr) : 0.0;
}

std::optional<TimeUnit> time_unit(const std::string& text) {
    if (const auto seconds = seconds_of(text))
        return TimeUnit{*seconds, false, 0, {}};
    // unit, year, month, day, hour, minute, second, zone's sign, hour and minute, calendar
    static const std::regex kDated(
        R"((\w+) since (\d{1,5})-(\d{1,2})-(\d{1,2})(?:[T ]+(\d{1,2}):(\d{1,2})(?::(\d{1,2}(?:\.\d*)?))?)?)"
        R"( *(?:Z|UTC|GMT)?(?: *([+-])(\d{1,2}):?(\d{2})?)?(?: \((\w+)\))?)");
    constexpr std::size_t kLongest = 200;
    std::smatch part;
    if (text.size() > kLongest || !std::regex_match(text, part, kDated))
        return std::nullopt;
    const auto seconds = seconds_of(part[1]);
    const auto days =
        days_to(static_cast<int>(number(part[2])), static_cast<unsigned>(number(part[3])),
                static_cast<unsigned>(number(part[4])), part[11]);
    if (!seconds || !days)
        return std::nullopt;
    const double zone =
        (part[8] == "-" ? -1 : 1) * (number(part[9]) * 3600 + number(part[10]) * 60);
    const double clock = number(part[5]) * 3600 + number(part[6]) * 60 + number(part[7]);
    return TimeUnit{*seconds, true, *days * 86400 + clock - zone, part[11]};
}

} // namespace

std::optional<std::vector<double>> times_in(const std::string& wanted, const std::string& given,
                                            std::vector<double> times) {
    if (wanted == given)
        return times;
    const auto to = time_unit(wanted), from = time_unit(given);
    if (!to || !from || to->dated != from->dated || to->calendar != from->calendar)
        return std::nullopt;
    for (double& time : times)
        time = (time * from->seconds + (from->from - to->from)) / to->seconds;
    return times;
}

} // namespace isochron::index
