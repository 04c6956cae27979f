// How often which values occur in a series that grows.
#pragma once

#include "index/volume/value_type.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

constexpr std::size_t kHistogramBins = 256;

/// Counts the finite values in bins of width 2^e that begin at multiples of it: the smallest e, 0
/// at least for integers, with fewer than kMostBins bins from the lowest value to the highest. So
/// the counts depend on the values alone, whatever came first: merging two bins is exact.
struct ValueCounts {
    static constexpr std::int64_t kMostBins = 2048;

    double low = 0, high = 0;        ///< range of the stored finite values; no counts: of none
    std::uint64_t nan_values = 0;    ///< stored values that are NaN
    int exponent = 0;                ///< e
    std::int64_t first = 0;          ///< number of the first bin, which begins at first * 2^e
    std::vector<std::uint64_t> bins; ///< from that of the lowest value to that of the highest

    bool operator==(const ValueCounts&) const = default;

    /// Counts all of these. Infinite values, and those that scaling makes infinite, count nowhere.
    void add(ValueType type, Scaling scaling, std::span<const std::byte> stored);
    void merge(ValueType type, const ValueCounts& other);

    /// Range of the scaled values; 0 to 0 without any.
    double scaled_low(Scaling scaling) const;
    double scaled_high(Scaling scaling) const;
    /// kHistogramBins equal bins over the range of the scaled values. The values of a bin that
    /// crosses an edge are taken to lie evenly in it; integers in bins of width 1 are exact.
    std::vector<std::uint64_t> histogram(ValueType type, Scaling scaling) const;

    /// Whether bins and range fit each other, of what a file says.
    bool sound(ValueType type) const;

  private:
    void reach(ValueType type, double lowest, double highest);
};

} // namespace isochron::index
