// Finds the role and unit of a coordinate by the CF conventions and by its name.
#pragma once

#include "index/readers/decoders/netcdf/netcdf_file.h"

#include <optional>
#include <string_view>

namespace isochron::index {

enum class AxisRole : std::uint8_t { x, y, z, time };

/// The role by the attributes of a variable, after "NetCDF Climate and Forecast (CF) Metadata
/// Conventions", chapter 4, https://cfconventions.org.
std::optional<AxisRole> role_by_attributes(const NetcdfFile& file, const NetcdfVariable& variable);

/// The role by the name of a dimension, in upper or lower case.
std::optional<AxisRole> role_by_name(std::string_view dimension);

/// Whether a vertical coordinate increases downwards: by its attribute `positive`, or if it is a
/// pressure.
bool counts_downwards(const NetcdfFile& file, const NetcdfVariable& variable);

/// A short name for a unit: `degrees` for units of longitude and latitude, `m` for `meters`,
/// nothing for `1`, ...
std::string tidy_unit(std::string_view unit);

/// The length of a unit in meters; none if it is not a length. @param unit from `tidy_unit`
std::optional<double> meters(std::string_view unit);

} // namespace isochron::index
