// An instant for people, and its physical time.
#include "index/volume/instant_text.h"

#include "index/volume/time_unit.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace isochron::index {

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
    const std::array around{times[at.step], time_at(times, at), times[at.step + 1]};
    return time_text(around, 1, unit);
}

} // namespace isochron::index
