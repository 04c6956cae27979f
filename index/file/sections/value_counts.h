// Counts of values in bins, for the histogram of a series that grows.
#pragma once

#include "index/volume/value_type.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

constexpr std::size_t kHistogramBins = 256;

/// Counts the finite values in bins of width 2^e that begin at multiples of 2^e. e is the smallest
/// number (at least 0 for integers) with at most kMostBins bins from the lowest value to the
/// highest. Wider bins are exact sums of narrower ones, so the counts depend on the values only,
/// not on their order.
struct ValueCounts {
    static constexpr std::int64_t kMostBins = 2048;

    double low = 0, high = 0;        ///< range of the stored finite values; 0 and 0 without any
    std::uint64_t nan_values = 0;    ///< stored values that are NaN
    int exponent = 0;                ///< e
    std::int64_t first = 0;          ///< number of the first bin, which begins at first * 2^e
    std::vector<std::uint64_t> bins; ///< from the lowest value's bin to the highest value's

    bool operator==(const ValueCounts&) const = default;

    /// Counts values. Those that are infinite, or are made infinite by scaling, are not counted.
    void add(ValueType type, Scaling scaling, std::span<const std::byte> stored);
    void merge(ValueType type, const ValueCounts& other);

    /// Range of the scaled values; 0 to 0 without any.
    double scaled_low(Scaling scaling) const;
    double scaled_high(Scaling scaling) const;
    /// kHistogramBins equal bins over the range of the scaled values. If one of `bins` crosses an
    /// edge, its values are assumed to be spread evenly; integers in bins of width 1 are exact.
    std::vector<std::uint64_t> histogram(ValueType type, Scaling scaling) const;

    /// Whether bins and range fit each other, for counts that were read from a file.
    bool sound(ValueType type) const;

  private:
    void reach(ValueType type, double lowest, double highest);
};

} // namespace isochron::index
