// What an HDF5 file states of a dataset, as the record that all containers fill.
#pragma once

#include "index/readers/decoders/hdf5/hdf5_arrays.h"
#include "index/readers/formats/stated/array_places.h"
#include "index/volume/volume_series.h"

#include <string>
#include <vector>

namespace isochron::index {

StatedAttributes attributes_of(const Hdf5File& file, const std::string& object);

/// The dataset with the groups around it, as `take_grid_attributes` takes them.
std::vector<StatedAttributes> objects_of(const Hdf5File& file, const Hdf5Dataset& dataset);

/// The record of a dataset, with coordinates from dimension scales, else from one-dimensional
/// datasets beside it that the labels of its dimensions or its attribute `coordinates` name.
/// @param values whether coordinates are read; roles need only names
StatedArray stated(const Hdf5File& file, const Hdf5Dataset& dataset, bool values);

/// Where nothing else places the axes of space: takes datasets `x`, `y` and `z` beside it or above.
/// @param notes what was taken from where
void take_coordinates(const Hdf5File& file, const Hdf5Dataset& dataset, const ArrayLayout& layout,
                      StatedArray& array, std::vector<std::string>& notes);

/// Sets times and their unit, if the file has them: from `time` and `timeUnitSI` of the groups of
/// the steps, or from the axis of time, or a dataset `time` with one value for each step.
/// @param steps number of steps
void time_hdf5(const Hdf5File& file, const Hdf5Array& array, const StatedArray& stated,
               const ArrayLayout& layout, std::size_t steps, SeriesInfo& info);

} // namespace isochron::index
