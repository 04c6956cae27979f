// Reads dates that are text.
#include "index/decoders/netcdf/netcdf_dates.h"

#include "index/formats/text_header.h"
#include "index/lower_case.h"
#include "index/volume/calendar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>

namespace isochron::index {
namespace {

constexpr std::size_t kLongest = 64; ///< characters of a date

const NetcdfVariable* text_of_dates(const NetcdfFile& file, const NetcdfDimension& time) {
    for (const NetcdfVariable& variable : file.variables()) {
        const std::string name =
            lower_case(variable.name.substr(variable.name.rfind('/') + 1)); // npos + 1 is 0
        if (!variable.type && variable.dimensions.size() == 2 &&
            variable.dimensions.front() == time && variable.dimensions.back().length <= kLongest &&
            (name == "times" || name == "xtime") && file.is_text(variable))
            return &variable;
    }
    return nullptr;
}

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

} // namespace

void place_dates(const NetcdfFile& file, const NetcdfDimension& time, SeriesInfo& info) {
    const NetcdfVariable* variable = text_of_dates(file, time);
    if (!variable)
        return;
    const std::size_t length = variable->dimensions.back().length;
    std::string all(time.length * length, '\0');
    file.read(*variable, std::vector<std::size_t>(2), std::vector{time.length, length},
              std::as_writable_bytes(std::span(all)));
    std::vector<double> times;
    std::string first;
    for (std::size_t step = 0; step < time.length; ++step) {
        const std::string text(all.substr(step * length, length).c_str());
        const auto seconds = seconds_of(text);
        if (!seconds) {
            info.notes.push_back(
                fmt::format("{} of step {} is no date: steps have no times", variable->name, step));
            return;
        }
        if (first.empty())
            first = text.substr(0, 19);
        times.push_back(*seconds);
    }
    if (times.empty())
        return;
    const double begin = *seconds_of(first);
    for (double& at : times)
        at -= begin;
    std::ranges::replace(first, '_', ' ');
    std::ranges::replace(first, 'T', ' ');
    info.times = std::move(times);
    info.time_unit = "seconds since " + first;
}

} // namespace isochron::index
