// The positions of the vertices of an HDF5 array, and the times of its steps.
#pragma once

#include "index/readers/decoders/hdf5/hdf5_arrays.h"

namespace isochron::index {

/// Sets origin, spacing, direction, unit of length and notes. Sources are, in this order: dimension
/// scales; the attributes of openPMD (`gridSpacing`, `gridGlobalOffset`, `gridUnitSI`,
/// `axisLabels`, `position`); datasets `x`, `y` and `z` beside the array or above it;
/// `element_size_um`; `dx`, `dy` and `dz`. A note names other attributes of that kind.
/// @throws Error naming the file: coordinates that neither rise nor fall
void place_hdf5(const Hdf5File& file, const Hdf5Dataset& dataset, const Hdf5Layout& layout,
                const ReadOptions& options, SeriesInfo& info);

/// Sets times and their unit, if the file has them: from `time` and `timeUnitSI` of the groups of
/// the steps, or from a dimension scale or dataset `time` with one value for each step.
/// @param steps number of steps
void time_hdf5(const Hdf5File& file, const Hdf5Array& array, const Hdf5Layout& layout,
               std::size_t steps, SeriesInfo& info);

} // namespace isochron::index
