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

/// Ticks in [low, high], at most `most` (which is at least 2), after P. Heckbert, "Nice numbers for
/// graph labels", Graphics Gems, 1990; none for an empty or infinite range.
Ticks nice_ticks(double low, double high, int most);

/// Logarithmic ticks in [low, high], both above 0; at most `most`. 1, 2 and 5 times each power of
/// ten if these are few enough, else the powers of ten alone, or every second or third of them.
/// `step` is the smallest tick.
Ticks logarithmic_ticks(double low, double high, int most);

/// The number with the digits that its neighbors need: `0.2`, `1500`, `2.5e-07`; never `-0`.
std::string tick_text(double value, double step);

} // namespace isochron::app
