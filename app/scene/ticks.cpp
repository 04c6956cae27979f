// Round numbers along an axis.
#include "app/scene/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace isochron::app {
namespace {

/// The smallest 1, 2 or 5 times a power of ten that is at least `number`.
double nice_above(double number) {
    const double decade = std::pow(10.0, std::floor(std::log10(number)));
    constexpr double kRounding = 1.0 + 1e-9;
    for (const double factor : {1.0, 2.0, 5.0})
        if (number <= factor * decade * kRounding)
            return factor * decade;
    return 10.0 * decade;
}

} // namespace

Ticks nice_ticks(double low, double high, int most) {
    const double span = high - low;
    if (!(span > 0) || !std::isfinite(span) || !std::isfinite(1 / span))
        return {};
    Ticks ticks;
    // Next to very large numbers, a smaller step would vanish by rounding.
    const double finest = 4e-16 * std::max(std::abs(low), std::abs(high));
    ticks.step = nice_above(std::max(span / std::max(most, 2), finest));
    const double inside = 1e-9; // share of a step by which rounding may move the ends
    for (;;) {
        const double first = std::ceil(low / ticks.step - inside);
        const double last = std::floor(high / ticks.step + inside);
        if (last - first + 1 <= std::max(most, 2)) {
            for (int k = 0; k <= last - first; ++k)
                ticks.values.push_back((first + k) * ticks.step);
            return ticks;
        }
        ticks.step = nice_above(ticks.step * 1.5);
    }
}

Ticks logarithmic_ticks(double low, double high, int most) {
    if (!(low > 0) || !(high > low) || !std::isfinite(high))
        return {};
    const int first = static_cast<int>(std::floor(std::log10(low)));
    const int last = static_cast<int>(std::floor(std::log10(high)));
    const auto within = [&](std::initializer_list<double> factors, int every) {
        Ticks ticks;
        for (int decade = first; decade <= last; ++decade) {
            if (decade % every != 0)
                continue;
            for (const double factor : factors) {
                const double value = factor * std::pow(10.0, decade);
                constexpr double kRounding = 1e-9;
                if (value >= low * (1 - kRounding) && value <= high * (1 + kRounding))
                    ticks.values.push_back(value);
            }
        }
        ticks.step = ticks.values.empty() ? 0 : ticks.values.front();
        return ticks;
    };
    const auto count = [](const Ticks& ticks) { return static_cast<int>(ticks.values.size()); };
    if (Ticks dense = within({1, 2, 5}, 1); count(dense) <= most)
        // A range within one decade may hold none of these: then ticks are as on a linear axis.
        return count(dense) < 2 ? nice_ticks(low, high, most) : dense;
    for (int every = 1;; ++every)
        if (Ticks ticks = within({1}, every); count(ticks) <= most)
            return ticks;
}

std::string tick_text(double value, double step) {
    if (std::abs(value) < 1e-6 * step)
        value = 0;
    const double size = std::max(std::abs(value), step);
    const int digits =
        static_cast<int>(std::floor(std::log10(size)) - std::floor(std::log10(step) + 1e-9)) + 1;
    const bool plain = size < 1e6 && step >= 1e-5;
    if (!plain)
        return value == 0 ? "0" : fmt::format("{:.{}e}", value, std::max(digits - 1, 0));
    const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
    return fmt::format("{:.{}f}", value, decimals);
}

} // namespace isochron::app
