// Reads steps of a NetCDF variable, with missing values as NaN.
#pragma once

#include "index/readers/decoders/netcdf/netcdf_axes.h"
#include "index/readers/formats/cropped_file.h"
#include "index/readers/process/reader_messages.h"

#include <limits>
#include <optional>

namespace isochron::index {

/// The stored values that are missing by the attributes `_FillValue`, `missing_value`, `valid_min`,
/// `valid_max` and `valid_range`.
class MissingValues {
  public:
    /// @throws Error when limits need the scaling and it is invalid
    MissingValues(const NetcdfFile& file, const NetcdfVariable& variable);

    bool possible() const { return !values_.empty() || low_ > -kInfinity || high_ < kInfinity; }
    /// @param stored for NaN the result is false: it is NaN already
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

/// Reads slices of one step, converted as `chosen` says.
/// @param grid of the whole step, or of the part
/// @param part of the variable that is wanted; none: all
/// @param out values of `chosen.value_type()`, [slowest]...[fastest]
void read_netcdf_slab(const NetcdfFile& file, const NetcdfVariable& variable,
                      const NetcdfLayout& layout, std::size_t step, Slices slices,
                      const ChosenScalar& chosen, const MissingValues& missing, const Grid& grid,
                      const std::optional<VolumePart>& part, std::span<std::byte> out);

} // namespace isochron::index
