// What a NetCDF file states of a variable, as the record that all containers fill.
#pragma once

#include "index/readers/decoders/netcdf/netcdf_file.h"
#include "index/readers/formats/stated/stated_array.h"

#include <optional>
#include <string>
#include <vector>

namespace isochron::index {

StatedAttributes attributes_of(const NetcdfFile& file, const NetcdfVariable& variable);
/// Those of the variable or the group at a path; empty: the root.
StatedAttributes attributes_of(const NetcdfFile& file, const std::string& path);

/// The variable with its group and the groups around that, as `take_grid_attributes` takes them.
std::vector<StatedAttributes> objects_of(const NetcdfFile& file, const NetcdfVariable& variable);

/// The record of a variable. @param values whether coordinates are read; roles need only names
StatedArray stated(const NetcdfFile& file, const NetcdfVariable& variable, bool values);

/// A variable of a group that is one time, by its standard name or its own; none.
/// @param group its path; empty: the root
std::optional<StatedAxis> time_in(const NetcdfFile& file, const std::string& group);

} // namespace isochron::index
