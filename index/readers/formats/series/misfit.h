// How far interpolated values are from the values of the source.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace isochron::index {

/// Collects differences at places of the source.
class Misfit {
  public:
    /// Does nothing if the value is not finite. If only the interpolated one is not, the value
    /// counts for the range alone.
    void add(double value, double interpolated) {
        if (!std::isfinite(value))
            return;
        low_ = std::min(low_, value);
        high_ = std::max(high_, value);
        if (!std::isfinite(interpolated))
            return;
        const double off = std::abs(interpolated - value);
        most_ = std::max(most_, off);
        squares_ += off * off;
        ++count_;
    }

    /// `at most 0.5 % of the values' range off, 0.1 % root mean square`: the largest difference, and
    /// the root mean square.
    std::string text() const {
        const double range = std::max(high_ - low_, 1e-300);
        const double mean = count_ > 0 ? std::sqrt(squares_ / static_cast<double>(count_)) : 0;
        return fmt::format("at most {:.2g} % of the values' range off, {:.2g} % root mean square",
                           100 * most_ / range, 100 * mean / range);
    }

  private:
    double most_ = 0, squares_ = 0, low_ = HUGE_VAL, high_ = -HUGE_VAL;
    std::uint64_t count_ = 0;
};

} // namespace isochron::index
