// What an HDF5 file states of a dataset, as the record that all containers fill.
#pragma once

#include "index/readers/decoders/hdf5/hdf5_file.h"
#include "index/readers/formats/stated/array_places.h"

#include <cstdint>
#include <optional>
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

/// The paths of an object, its group, and the groups around that, up to the root.
std::vector<std::string> with_groups_around(std::string path);

/// The path of something in a group.
std::string inside(const std::string& group, const std::string& name);

/// A one-dimensional dataset of numbers as coordinates; none: it is no such, or of another length.
std::optional<StatedAxis> coordinates_in(const Hdf5File& file, const std::string& path,
                                         std::uint64_t length, bool values);

} // namespace isochron::index
