// Formats figures with the number of digits that is reliable.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace isochron::bench {

/// Three digits, or all before the point: `0.0123`, `126`, `1034`.
inline std::string short_number(double value) {
    return std::abs(value) < 999.5 ? fmt::format("{:.3g}", value) : fmt::format("{:.0f}", value);
}

} // namespace isochron::bench
