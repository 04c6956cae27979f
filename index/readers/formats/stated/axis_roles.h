// Finds the role of an axis by the CF conventions, by OME-Zarr's types and by its name.
#pragma once

#include "index/readers/formats/stated/stated_array.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace isochron::index {

/// `channel`: components or channels; `member`: runs of an ensemble.
enum class AxisRole : std::uint8_t { x, y, z, time, channel, member };

/// The role by the attributes of an axis' coordinates, after "NetCDF Climate and Forecast (CF)
/// Metadata Conventions", chapter 4, https://cfconventions.org, or by its kind.
std::optional<AxisRole> role_by_attributes(const StatedAxis& axis);

/// The role by the name of a dimension, in upper or lower case.
std::optional<AxisRole> role_by_name(std::string_view dimension);

/// Whether a vertical coordinate increases downwards: by its attribute `positive`, or if it is a
/// pressure.
bool counts_downwards(const StatedAxis& axis);

/// A short name for a unit: `degrees` for units of longitude and latitude, `m` for `meters`,
/// nothing for `1`, ...
std::string tidy_unit(const std::string& unit);

} // namespace isochron::index
