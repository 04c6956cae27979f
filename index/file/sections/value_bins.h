// Extremes and bins of many stored values at a time.
#pragma once

#include "index/volume/value_type.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace isochron::index {

/// The lowest and the highest of some values; `low` is above `high` where there are none.
struct StoredExtremes {
    double low = 0, high = 0;
    bool all_finite = true; ///< no value is infinite or NaN; else the extremes have no meaning
};
/// Extremes of values of i16, u16, i32 and f32.
StoredExtremes stored_extremes(ValueType type, std::span<const std::byte> stored);

/// Adds 1 to the bin of each value: bin floor(value * per_width) - first, which must be one of `bins`.
/// @param per_width a power of two
void count_in_bins(ValueType type, std::span<const std::byte> stored, double per_width,
                   std::int64_t first, std::span<std::uint64_t> bins);

} // namespace isochron::index
