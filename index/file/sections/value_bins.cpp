// Finds bins of several values at a time; increments of counters follow from a small buffer.
#include "index/file/sections/value_bins.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "index/file/sections/value_bins.cpp"
#include <hwy/foreach_target.h> // must come before highway.h

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Lowest, highest, and whether all are finite: a NaN or an infinity has all bits of the exponent.
template <class T>
StoredExtremes extremes_of(const T* values, std::size_t count) {
    const hn::ScalableTag<T> d;
    StoredExtremes found{std::numeric_limits<double>::infinity(),
                         -std::numeric_limits<double>::infinity(), true};
    T low = std::numeric_limits<T>::max(), high = std::numeric_limits<T>::lowest();
    std::size_t i = 0;
    if (count >= hn::Lanes(d)) {
        auto lowest = hn::LoadU(d, values), highest = lowest;
        auto sum = hn::Zero(d); // sum of 0 for each finite value, and of NaN for each other
        for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
            const auto value = hn::LoadU(d, values + i);
            lowest = hn::Min(lowest, value);
            highest = hn::Max(highest, value);
            if constexpr (hwy::IsFloat<T>())
                sum = hn::Add(sum, hn::Sub(value, value));
        }
        std::array<T, hn::MaxLanes(d)> lows, highs, sums;
        hn::StoreU(lowest, d, lows.data());
        hn::StoreU(highest, d, highs.data());
        hn::StoreU(sum, d, sums.data());
        for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
            low = std::min(low, lows[lane]);
            high = std::max(high, highs[lane]);
            found.all_finite &= sums[lane] == T{0};
        }
    }
    for (; i < count; ++i) {
        low = std::min(low, values[i]);
        high = std::max(high, values[i]);
        found.all_finite &= values[i] - values[i] == 0;
    }
    if (count > 0) {
        // Which of two zeros comes first depends on the target.
        found.low = static_cast<double>(low) + 0.0;
        found.high = static_cast<double>(high) + 0.0;
    }
    return found;
}

constexpr std::size_t kAtOnce = 1024; ///< values whose bins are found before they are counted

/// The bins of up to kAtOnce values.
template <class T>
void bins_of(const T* values, std::size_t count, double per_width, std::int64_t first,
             std::int32_t* out) {
    const auto before = static_cast<double>(first); // exact, as are the differences
    std::size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
    const hn::ScalableTag<double> d;
    const hn::Rebind<std::int32_t, decltype(d)> narrow;
    const hn::Rebind<T, decltype(d)> stored;
    const auto factor = hn::Set(d, per_width), from = hn::Set(d, before);
    for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
        const auto value = hn::LoadU(stored, values + i);
        const auto exact = [&] {
            if constexpr (sizeof(T) == 2)
                return hn::PromoteTo(d, hn::PromoteTo(narrow, value));
            else
                return hn::PromoteTo(d, value);
        }();
        const auto bin = hn::Sub(hn::Floor(hn::Mul(exact, factor)), from);
        hn::StoreU(hn::DemoteTo(narrow, bin), narrow, out + i);
    }
#endif
    for (; i < count; ++i)
        out[i] = static_cast<std::int32_t>(std::floor(static_cast<double>(values[i]) * per_width) -
                                           before);
}

template <class T>
void count_bins(const T* values, std::size_t count, double per_width, std::int64_t first,
                std::span<std::uint64_t> bins) {
    // Increments of one counter wait for each other, and neighbors are often in the same bin.
    constexpr std::size_t kSets = 4;
    std::vector<std::uint64_t> counts(kSets * bins.size());
    std::array<std::uint64_t*, kSets> of{};
    for (std::size_t set = 0; set < kSets; ++set)
        of[set] = counts.data() + set * bins.size();
    std::array<std::int32_t, kAtOnce> at;
    for (std::size_t begin = 0; begin < count; begin += kAtOnce) {
        const std::size_t some = std::min(kAtOnce, count - begin);
        bins_of(values + begin, some, per_width, first, at.data());
        std::size_t i = 0;
        for (; i + kSets <= some; i += kSets)
            for (std::size_t set = 0; set < kSets; ++set)
                ++of[set][at[i + set]];
        for (; i < some; ++i)
            ++of[0][at[i]];
    }
    for (std::size_t i = 0; i < counts.size(); ++i)
        bins[i % bins.size()] += counts[i];
}

template <class F>
void with_type(ValueType type, const std::byte* stored, F&& f) {
    switch (type) {
    case ValueType::i16: return f(reinterpret_cast<const std::int16_t*>(stored));
    case ValueType::u16: return f(reinterpret_cast<const std::uint16_t*>(stored));
    case ValueType::i32: return f(reinterpret_cast<const std::int32_t*>(stored));
    default: return f(reinterpret_cast<const float*>(stored));
    }
}

StoredExtremes find_extremes(ValueType type, const std::byte* stored, std::size_t bytes) {
    StoredExtremes found;
    with_type(type, stored,
              [&]<class T>(const T* values) { found = extremes_of(values, bytes / sizeof(T)); });
    return found;
}

void add_to_bins(ValueType type, const std::byte* stored, std::size_t bytes, double per_width,
                 std::int64_t first, std::span<std::uint64_t> bins) {
    with_type(type, stored, [&]<class T>(const T* values) {
        count_bins(values, bytes / sizeof(T), per_width, first, bins);
    });
}

} // namespace
} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::index {

HWY_EXPORT(find_extremes);
HWY_EXPORT(add_to_bins);

StoredExtremes stored_extremes(ValueType type, std::span<const std::byte> stored) {
    return HWY_DYNAMIC_DISPATCH(find_extremes)(type, stored.data(), stored.size());
}

void count_in_bins(ValueType type, std::span<const std::byte> stored, double per_width,
                   std::int64_t first, std::span<std::uint64_t> bins) {
    HWY_DYNAMIC_DISPATCH(add_to_bins)(type, stored.data(), stored.size(), per_width, first, bins);
}

} // namespace isochron::index
#endif
