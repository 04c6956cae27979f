// The times of the steps of an HDF5 array.
#pragma once

#include "index/readers/decoders/hdf5/hdf5_arrays.h"
#include "index/readers/formats/stated/array_places.h"
#include "index/volume/volume_series.h"

#include <cstddef>

namespace isochron::index {

/// Sets times and their unit, if the file has them: from `time` and `timeUnitSI` of the groups of
/// the steps, or from the axis of time, or a dataset `time` with one value for each step.
/// @param steps number of steps
void time_hdf5(const Hdf5File& file, const Hdf5Array& array, const StatedArray& stated,
               const ArrayLayout& layout, std::size_t steps, const ReadOptions& options,
               SeriesInfo& info);

} // namespace isochron::index
