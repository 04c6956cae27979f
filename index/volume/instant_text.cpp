// An instant for people, and its physical time.
#include "index/volume/instant_text.h"

#include "index/volume/time_unit.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace isochron::index {
namespace {

/// A time between two steps as people write it: with a date, to the second, minute or the like that
/// is finer than a 500th of what lies between the steps, instead of to a 65536th of it.
double written_time(double before, double time, double after, const std::string& unit) {
    constexpr std::array kSteps{3600.0, 60.0, 1.0, 0.1, 0.01, 0.001}; // [s]
    constexpr double kFiner = 500;
    const auto of_one = times_in("s", unit.substr(0, unit.find(" since ")), {1.0});
    if (!of_one || unit.find(" since ") == unit.npos)
        return time;
    const double seconds = of_one->front();
    for (const double step : kSteps)
        if (kFiner * step <= (after - before) * seconds) {
            const double rounded = std::round(time * seconds / step) * step / seconds;
            return before < rounded && rounded < after ? rounded : time;
        }
    return time;
}

} // namespace

double time_at(std::span<const double> times, Instant at) {
    at = at.within(times.size());
    return at.between() ? std::lerp(times[at.step], times[at.step + 1],
                                    static_cast<double>(at.fraction) / Instant::kFractions)
                        : times[at.step];
}

std::string number_text(Instant at) {
    return at.between() ? fmt::format("{} + {}/{}", at.step, at.fraction, Instant::kFractions)
                        : fmt::format("{}", at.step);
}

std::string instant_text(std::span<const double> times, Instant at, const std::string& unit) {
    at = at.within(times.size());
    if (!at.between())
        return time_text(times, at.step, unit);
    const double before = times[at.step], after = times[at.step + 1];
    const std::array around{before, written_time(before, time_at(times, at), after, unit), after};
    return time_text(around, 1, unit);
}

} // namespace isochron::index
