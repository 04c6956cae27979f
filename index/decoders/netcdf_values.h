// The values of a NetCDF variable: steps of it, with what is missing as NaN.
#pragma once

#include "index/decoders/netcdf_axes.h"
#include "index/reader/reader_messages.h"

#include <limits>

namespace isochron::index {

/// What stands for a missing value, as `_FillValue`, `missing_value`, `valid_min`, `valid_max` and
/// `valid_range` say, in stored values.
class MissingValues {
  public:
    /// @throws Error when the scaling that limits need is none
    MissingValues(const NetcdfFile& file, const NetcdfVariable& variable);

    bool possible() const { return !values_.empty() || low_ > -kInfinity || high_ < kInfinity; }
    /// @param stored NaN is not missing: it is NaN already
    bool contain(double stored) const {
        for (const double value : values_)
            if (stored == value)
                return true;
        return stored < low_ || stored > high_;
    }

  private:
    static constexpr double kInfinity = std::numeric_limits<double>::infinity();

    std::vector<double> values_;
    double low_ = -kInfinity, high_ = kInfinity;
};

/// Reads slices of one step as `chosen` has it.
/// @param grid of the whole step
/// @param out values of `chosen.value_type()`, [slowest]...[fastest]
void read_netcdf_slab(const NetcdfFile& file, const NetcdfVariable& variable,
                      const NetcdfLayout& layout, std::size_t step, Slices slices,
                      const ChosenScalar& chosen, const MissingValues& missing, const Grid& grid,
                      std::span<std::byte> out);

} // namespace isochron::index
