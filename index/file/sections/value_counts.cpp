// Counts values in bins that can be merged.
#include "index/file/sections/value_counts.h"

#include "index/file/sections/value_bins.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace isochron::index {
namespace {

constexpr int kLeastExponent = -1022; ///< so that 2^-e is finite
/// Bin numbers stay below 2^52, so that doubles hold them exactly.
constexpr int kMostBinBits = 51;

bool is_integer(ValueType type) {
    return type != ValueType::f32 && type != ValueType::f64;
}

std::int64_t bin_of(double value, double per_width) {
    return static_cast<std::int64_t>(std::floor(value * per_width));
}

int exponent_for(ValueType type, double low, double high) {
    const double most = std::max(std::abs(low), std::abs(high));
    int exponent = is_integer(type) ? 0 : kLeastExponent;
    if (most > 0)
        exponent = std::max(exponent, std::ilogb(most) - kMostBinBits);
    for (;; ++exponent) {
        const double per_width = std::ldexp(1.0, -exponent);
        if (bin_of(high, per_width) - bin_of(low, per_width) < ValueCounts::kMostBins)
            return exponent;
    }
}

/// Counts each byte. Of many bytes it counts pairs, which changes half as many counters. Of few
/// bytes it counts single ones, in four sets of counters: equal bytes often follow each other, and
/// increments of one counter wait for each other.
std::array<std::uint64_t, 256> numbers_of_bytes(std::span<const std::byte> bytes) {
    constexpr std::size_t kWorthPairs = 1 << 20; ///< their counters have to be cleared and summed
    constexpr std::size_t kPairs = 1 << 16;
    constexpr std::size_t kMostAtOnce = std::size_t{1} << 31; ///< so that no counter overflows
    std::array<std::array<std::uint64_t, 256>, 4> parts{};
    std::array<std::uint64_t, 256>& numbers = parts[0];
    const auto* const in = reinterpret_cast<const std::uint8_t*>(bytes.data());
    std::size_t i = 0;
    std::vector<std::uint32_t> pairs;
    while (bytes.size() - i >= kWorthPairs) {
        pairs.assign(kPairs, 0);
        const std::size_t end = i + std::min(bytes.size() - i, kMostAtOnce) / 8 * 8;
        for (; i < end; i += 8) {
            std::uint64_t word = 0;
            std::memcpy(&word, in + i, sizeof word);
            for (unsigned shift = 0; shift < 64; shift += 16)
                ++pairs[word >> shift & 0xffff];
        }
        for (std::size_t pair = 0; pair < kPairs; ++pair) {
            numbers[pair & 0xff] += pairs[pair];
            numbers[pair >> 8] += pairs[pair];
        }
    }
    for (; i + 4 <= bytes.size(); i += 4)
        for (std::size_t part = 0; part < 4; ++part)
            ++parts[part][in[i + part]];
    for (; i < bytes.size(); ++i)
        ++numbers[in[i]];
    for (std::size_t part = 1; part < 4; ++part)
        for (std::size_t value = 0; value < 256; ++value)
            numbers[value] += parts[part][value];
    return numbers;
}

/// The place of a value in a histogram. Halves keep the width finite for any two doubles.
struct Axis {
    Axis(double from, double to) : low(from) {
        const double half_width = to / 2 - from / 2;
        per_half = half_width > 0 ? static_cast<double>(kHistogramBins) / half_width : 0.0;
    }
    double at(double value) const {
        const double place = (value / 2 - low / 2) * per_half;
        // A denormal width makes the factor infinite and 0 * infinity a NaN, which counts as 0.
        return place > 0 ? std::min(place, static_cast<double>(kHistogramBins)) : 0;
    }
    double low, per_half;
};

} // namespace

void ValueCounts::reach(ValueType type, double lowest, double highest) {
    if (bins.empty()) {
        low = lowest;
        high = highest;
    } else if (lowest >= low && highest <= high) {
        return;
    }
    low = std::min(low, lowest);
    high = std::max(high, highest);
    const int wanted = exponent_for(type, low, high);
    const double per_width = std::ldexp(1.0, -wanted);
    const std::int64_t from = bin_of(low, per_width);
    std::vector<std::uint64_t> wider(static_cast<std::size_t>(bin_of(high, per_width) - from + 1));
    for (std::size_t i = 0; i < bins.size(); ++i) {
        // Arithmetic shifts round down, as floor does.
        const std::int64_t bin =
            (first + static_cast<std::int64_t>(i)) >> std::min(wanted - exponent, 63);
        wider[static_cast<std::size_t>(bin - from)] += bins[i];
    }
    exponent = wanted;
    first = from;
    bins = std::move(wider);
}

void ValueCounts::add(ValueType type, Scaling scaling, std::span<const std::byte> stored) {
    visit_value_type(type, [&]<class T>(std::type_identity<T>) {
        const std::span values(reinterpret_cast<const T*>(stored.data()),
                               stored.size() / sizeof(T));
        const auto counts = [&](double value) { return std::isfinite(scaling(value)); };
        if constexpr (sizeof(T) == 1) { // counts bytes first, since there are only 256
            const std::array<std::uint64_t, 256> numbers = numbers_of_bytes(stored);
            for (std::size_t i = 0; i < numbers.size(); ++i) {
                const double value = static_cast<T>(i);
                if (numbers[i] == 0 || !counts(value))
                    continue;
                reach(type, value, value);
                bins[static_cast<std::size_t>(bin_of(value, std::ldexp(1.0, -exponent)) - first)] +=
                    numbers[i];
            }
            return;
        }
        if constexpr (sizeof(T) <= 4) {
            // Scaling is monotone: where it keeps both extremes finite, it keeps all values finite.
            const StoredExtremes found = stored_extremes(type, stored);
            if (!values.empty() && found.all_finite && counts(found.low) && counts(found.high)) {
                reach(type, found.low, found.high);
                return count_in_bins(type, stored, std::ldexp(1.0, -exponent), first, bins);
            }
        }
        double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
        for (const T value : values) {
            const auto number = static_cast<double>(value);
            if (counts(number)) {
                lowest = std::min(lowest, number);
                highest = std::max(highest, number);
            } else {
                nan_values += std::isnan(number);
            }
        }
        if (lowest > highest)
            return;
        reach(type, lowest, highest);
        const double per_width = std::ldexp(1.0, -exponent);
        for (const T value : values)
            if (const auto number = static_cast<double>(value); counts(number))
                ++bins[static_cast<std::size_t>(bin_of(number, per_width) - first)];
    });
}

void ValueCounts::merge(ValueType type, const ValueCounts& other) {
    nan_values += other.nan_values;
    if (other.bins.empty())
        return;
    ValueCounts wider = other;
    if (!bins.empty())
        wider.reach(type, low, high);
    reach(type, wider.low, wider.high);
    for (std::size_t i = 0; i < bins.size(); ++i)
        bins[i] += wider.bins[i];
}

double ValueCounts::scaled_low(Scaling scaling) const {
    return bins.empty() ? 0 : scaling(scaling.slope < 0 ? high : low);
}
double ValueCounts::scaled_high(Scaling scaling) const {
    return bins.empty() ? 0 : scaling(scaling.slope < 0 ? low : high);
}

std::vector<std::uint64_t> ValueCounts::histogram(ValueType type, Scaling scaling) const {
    std::vector<std::uint64_t> out(kHistogramBins);
    const Axis axis(scaled_low(scaling), scaled_high(scaling));
    const bool exact = is_integer(type) && exponent == 0;
    const double width = std::ldexp(1.0, exponent);
    const std::size_t count = bins.size();
    std::uint64_t before = 0, placed = 0; // values below a bin; in bins of `out` before `next`
    std::size_t next = 0;
    const auto fill_to = [&](std::size_t edge, double below) {
        for (; next < edge; ++next) {
            const auto sum = static_cast<std::uint64_t>(std::llround(below));
            out[next] = sum - std::min(sum, placed);
            placed = std::max(placed, sum);
        }
    };
    for (std::size_t n = 0; n < count; ++n) {
        const std::size_t i = scaling.slope < 0 ? count - 1 - n : n;
        const double begin =
            std::max((static_cast<double>(first) + static_cast<double>(i)) * width, low);
        if (exact) {
            const double place = axis.at(scaling(begin));
            out[std::min(static_cast<std::size_t>(place), kHistogramBins - 1)] += bins[i];
            continue;
        }
        const double end = std::min(begin + width, high);
        double a = axis.at(scaling(begin)), b = axis.at(scaling(end));
        if (a > b)
            std::swap(a, b);
        // For an edge within the bin, a part of the bin's values is below it.
        for (std::size_t edge = next + 1; edge < kHistogramBins && static_cast<double>(edge) <= b;
             ++edge) {
            const double part = b > a ? (static_cast<double>(edge) - a) / (b - a) : 0;
            fill_to(edge, static_cast<double>(before) +
                              std::clamp(part, 0.0, 1.0) * static_cast<double>(bins[i]));
        }
        before += bins[i];
    }
    if (!exact)
        out[kHistogramBins - 1] = before - placed;
    if (!exact && next + 1 < kHistogramBins) { // all values are equal
        out.assign(kHistogramBins, 0);
        out[0] = before;
    }
    return out;
}

bool ValueCounts::sound(ValueType type) const {
    if (bins.empty())
        return low == 0 && high == 0;
    if (!std::isfinite(low) || !std::isfinite(high) || !(low <= high) ||
        exponent != exponent_for(type, low, high))
        return false;
    const double per_width = std::ldexp(1.0, -exponent);
    return first == bin_of(low, per_width) &&
           static_cast<std::int64_t>(bins.size()) == bin_of(high, per_width) - first + 1;
}

} // namespace isochron::index
