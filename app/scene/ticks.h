// Round numbers along an axis.
#pragma once

#include <string>
#include <vector>

namespace isochron::app {

/// Multiples of 1, 2 or 5 times a power of ten.
struct Ticks {
    double step = 0;            ///< 0 where there are none
    std::vector<double> values; ///< ascending, within the range
};

/// As many ticks as fit into [low, high], at most `most` (at least 2), after P. Heckbert, "Nice
/// numbers for graph labels", Graphics Gems, 1990; none for an empty or infinite range.
Ticks nice_ticks(double low, double high, int most);

/// Powers of ten in [low, high], both above 0, and where there are few of them their double and
/// fivefold, or else every second, third ... of them, so that there are at most `most`; `step` is
/// that of the smallest.
Ticks logarithmic_ticks(double low, double high, int most);

/// The number with the digits that its neighbors need: `0.2`, `1500`, `2.5e-07`; never `-0`.
std::string tick_text(double value, double step);

} // namespace isochron::app
