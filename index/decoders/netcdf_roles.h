// What a coordinate stands for, by the CF conventions and by its name.
#pragma once

#include "index/decoders/netcdf_file.h"

#include <optional>
#include <string_view>

namespace isochron::index {

enum class AxisRole : std::uint8_t { x, y, z, time };

/// What the attributes of a variable say, after "NetCDF Climate and Forecast (CF) Metadata
/// Conventions", chapter 4, https://cfconventions.org.
std::optional<AxisRole> role_by_attributes(const NetcdfFile& file, const NetcdfVariable& variable);

/// What the name of a dimension says, in any case.
std::optional<AxisRole> role_by_name(std::string_view dimension);

/// Whether a vertical coordinate grows downwards: `positive` says so, or it is a pressure.
bool counts_downwards(const NetcdfFile& file, const NetcdfVariable& variable);

/// `degrees` for those of longitude and latitude, `m` for `meters`, nothing for `1`, ...
std::string tidy_unit(std::string_view unit);

/// Meters of a unit of length, none for what is no length. @param unit tidy
std::optional<double> meters(std::string_view unit);

} // namespace isochron::index
