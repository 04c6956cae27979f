// Random numbers that are the same on every platform, unlike the standard library's distributions.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace isochron::app {

/// Uniform in (0, 1), without 0, so that the logarithm exists, and without 1.
inline double uniform(std::mt19937_64& bits) {
    return (static_cast<double>(bits() >> 11) + 0.5) * 0x1p-53;
}

/// Two independent normal deviates (Box and Muller, Ann. Math. Stat. 29, 1958).
inline std::array<double, 2> normal_pair(std::mt19937_64& bits) {
    const double radius = std::sqrt(-2.0 * std::log(uniform(bits)));
    const double angle = 2.0 * std::numbers::pi * uniform(bits);
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

} // namespace isochron::app
