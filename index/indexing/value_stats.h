// Range and counts of the values that all members of a team have seen.
#pragma once

#include "index/file/index_file.h"
#include "index/system/team.h"

#include <limits>

namespace isochron::index {

/// Range of the finite scaled values seen so far; `low` is above `high` while there are none.
struct ValueRange {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    std::uint64_t nan_values = 0;
};

/// The range that all members of a team have seen together; 0 to 0 if nobody saw a finite value.
ValueRange agreed_range(const ValueRange& mine, Team& team);

/// The counts of all members of a team together.
ValueCounts agreed_counts(const ValueCounts& mine, ValueType type, Team& team);

/// Extends the range by one step's finite scaled values and counts its NaN. Call with `low` =
/// infinity and `high` = -infinity at first.
/// @param stored as in `VolumeSeries::read`
void add_range(ValueType type, Scaling scaling, std::span<const std::byte> stored, double& low,
               double& high, std::uint64_t& nan_values);

} // namespace isochron::index
