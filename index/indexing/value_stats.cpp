// Range and counts of the values that all members of a team have seen.
#include "index/indexing/value_stats.h"

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

ValueCounts agreed_counts(const ValueCounts& mine, ValueType type, Team& team) {
    struct Head {
        double low, high;
        std::uint64_t nan_values;
        std::int64_t exponent, first;
        std::uint64_t bins;
    };
    const auto heads = team.gather_values(
        Head{mine.low, mine.high, mine.nan_values, mine.exponent, mine.first, mine.bins.size()});
    const std::vector<std::uint64_t> bins = team.gather_items(mine.bins);
    ValueCounts all;
    auto next = bins.begin();
    for (const Head& head : heads) {
        ValueCounts one{.low = head.low,
                        .high = head.high,
                        .nan_values = head.nan_values,
                        .exponent = static_cast<int>(head.exponent),
                        .first = head.first,
                        .bins = {}};
        one.bins.assign(next, next + static_cast<std::ptrdiff_t>(head.bins));
        next += static_cast<std::ptrdiff_t>(head.bins);
        all.merge(type, one);
    }
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

} // namespace isochron::index
