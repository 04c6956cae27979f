// Range, NaN count and histogram of a series.
#include "index/build/value_stats.h"

#include <algorithm>
#include <cmath>

namespace isochron::index {
namespace {

/// Calls `f(scaled)` for every stored value.
template <class F>
void for_each_scaled(ValueType type, Scaling scaling, std::span<const std::byte> stored, F&& f) {
    visit_value_type(type, [&]<class T>(std::type_identity<T>) {
        const auto* values = reinterpret_cast<const T*>(stored.data());
        for (std::size_t i = 0; i < stored.size() / sizeof(T); ++i)
            f(scaling(static_cast<double>(values[i])));
    });
}

} // namespace

ValueRange agreed_range(const ValueRange& mine, Team& team) {
    ValueRange all;
    for (const ValueRange& range : team.gather_values(mine)) {
        all.low = std::min(all.low, range.low);
        all.high = std::max(all.high, range.high);
        all.nan_values += range.nan_values;
    }
    if (all.low > all.high)
        all.low = all.high = 0;
    return all;
}

void add_range(ValueType type, Scaling scaling, std::span<const std::byte> stored, double& low,
               double& high, std::uint64_t& nan_values) {
    double least = low, greatest = high;
    std::uint64_t nans = 0;
    for_each_scaled(type, scaling, stored, [&](double value) {
        if (std::isfinite(value)) {
            least = std::min(least, value);
            greatest = std::max(greatest, value);
        } else {
            nans += std::isnan(value);
        }
    });
    low = least;
    high = greatest;
    nan_values += nans;
}

void add_histogram(ValueType type, Scaling scaling, std::span<const std::byte> stored, double low,
                   double high, std::span<std::uint64_t> bins) {
    // Halves keep the width finite for any two doubles.
    const double half_width = high / 2 - low / 2;
    const double last = static_cast<double>(bins.size() - 1);
    const double per_half = half_width > 0 ? static_cast<double>(bins.size()) / half_width : 0.0;
    for_each_scaled(type, scaling, stored, [&](double value) {
        if (!std::isfinite(value))
            return;
        // A denormal width makes the factor infinite and 0 * infinity a NaN, which counts as 0.
        const double bin = (value / 2 - low / 2) * per_half;
        ++bins[bin > 0 ? static_cast<std::size_t>(std::min(bin, last)) : 0];
    });
}

} // namespace isochron::index
