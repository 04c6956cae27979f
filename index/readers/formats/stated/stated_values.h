// What a container states of the values of an array: scaling, unit, and which values are missing.
#pragma once

#include "index/readers/formats/stated/stated_array.h"
#include "index/readers/formats/stored_scalar.h"

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace isochron::index {

/// The scaling by `scale_factor` (or openPMD's `unitSI`) and `add_offset`.
/// @param where file and array, for messages @throws Error: not finite, or the factor is 0
Scaling scaling_by(const StatedAttributes& array, const std::string& where);

/// The unit of the values: `units`, `unit`; nothing for `1`.
std::string value_unit_by(const StatedAttributes& array);

/// The stored values that are missing by the attributes `_FillValue`, `missing_value`, `valid_min`,
/// `valid_max` and `valid_range` (CF conventions, section 2.5.1).
class MissingValues {
  public:
    MissingValues() = default;
    /// @param fills further values that stand for missing ones
    /// @param where as in `scaling_by` @throws Error when limits need the scaling and it is invalid
    MissingValues(const StatedAttributes& array, StoredType type, const std::vector<double>& fills,
                  const std::string& where);

    bool possible() const { return !values_.empty() || low_ > -kInfinity || high_ < kInfinity; }
    /// @param stored for NaN the result is false: it is NaN already
    bool contain(double stored) const {
        for (const double value : values_)
            if (stored == value)
                return true;
        return stored < low_ || stored > high_;
    }
    /// Whether integers may be missing, for which only NaN can stand: see `StoredArray::gaps`.
    bool make_gaps(StoredType type) const {
        return possible() && type != StoredType::f32 && type != StoredType::f64;
    }

  private:
    static constexpr double kInfinity = std::numeric_limits<double>::infinity();

    std::vector<double> values_;
    double low_ = -kInfinity, high_ = kInfinity;
};

/// Reads a slab of the chosen component, or of all for the magnitude, and converts it as `convert`
/// does; missing values become NaN.
/// @param count number of stored values of one component that `slab` is made of
/// @param load writes those of a component, as stored, native byte order
void read_stored(
    const ChosenScalar& chosen, const MissingValues& missing, std::size_t count, const Grid& slab,
    std::span<std::byte> out, const std::string& file,
    const std::function<void(std::size_t component, std::span<std::byte> plane)>& load);

} // namespace isochron::index
