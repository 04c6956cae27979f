// Range, NaN count and histogram of a series.
#pragma once

#include "index/index_file.h"

namespace isochron::index {

/// Extends the range by one step's finite scaled values and counts its NaN. Call with `low` =
/// infinity and `high` = -infinity at first.
/// @param stored as in `VolumeSeries::read`
void add_range(ValueType type, Scaling scaling, std::span<const std::byte> stored, double& low,
               double& high, std::uint64_t& nan_values);

/// Counts one step's finite scaled values into equal bins over [low, high].
void add_histogram(ValueType type, Scaling scaling, std::span<const std::byte> stored, double low,
                   double high, std::span<std::uint64_t> bins);

} // namespace isochron::index
