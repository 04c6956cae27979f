// What a Zarr hierarchy states of an array, as the record that all containers fill.
#pragma once

#include "index/readers/decoders/zarr/zarr_array.h"
#include "index/readers/formats/stated/stated_array.h"

#include <optional>
#include <vector>

namespace isochron::index {

StatedAttributes attributes_of(const nlohmann::json& attributes);

/// The array with the groups around it, as `take_grid_attributes` takes them.
std::vector<StatedAttributes> objects_of(const ZarrStore& store, const ZarrArray& array);

/// The axes of an array with the names of its dimensions, and with the coordinates in
/// one-dimensional arrays beside it, as xarray writes them.
std::vector<StatedAxis> axes_of(const ZarrStore& store, const ZarrArray& array);

/// The axes of an array as an OME-Zarr image states them: names, units, scales, translations.
/// @param image an entry of `multiscales` @param dataset the entry of its `datasets` that is the array
/// @throws nlohmann::json::exception: damaged
std::vector<StatedAxis> axes_of(const nlohmann::json& image, const nlohmann::json& dataset,
                                const ZarrArray& array);

/// The array `time` of one value in a group; none.
std::optional<StatedAxis> time_in(const ZarrStore& store, const std::string& group);

/// How many dimensions longer than 1 the array of a name beside this one has; 0: there is none.
std::size_t long_dimensions_of(const ZarrStore& store, const ZarrArray& array,
                               const std::string& beside);

/// The value of chunks that were never written, where names of dimensions say that xarray, for
/// which it stands for missing values, has written the array; empty: there is none.
std::vector<double> fills_of(const ZarrArray& array);

} // namespace isochron::index
