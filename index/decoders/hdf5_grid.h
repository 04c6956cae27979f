// Where the vertices of an HDF5 array lie, and when its steps are.
#pragma once

#include "index/decoders/hdf5_arrays.h"

namespace isochron::index {

/// Sets origin, spacing, direction, unit of length and notes: from dimension scales; from the
/// attributes of openPMD (`gridSpacing`, `gridGlobalOffset`, `gridUnitSI`, `axisLabels`,
/// `position`); from datasets `x`, `y` and `z` beside the array or above it; from `element_size_um`;
/// from `dx`, `dy` and `dz`. Other attributes of that kind are told in a note.
/// @throws Error naming the file: coordinates that neither rise nor fall
void place_hdf5(const Hdf5File& file, const Hdf5Dataset& dataset, const Hdf5Layout& layout,
                const ReadOptions& options, SeriesInfo& info);

/// Sets times and their unit from `time` and `timeUnitSI` of the groups of the steps, or from a
/// dimension scale or dataset `time` of as many values, if anything gives them.
/// @param steps how many there are
void time_hdf5(const Hdf5File& file, const Hdf5Array& array, const Hdf5Layout& layout,
               std::size_t steps, SeriesInfo& info);

} // namespace isochron::index
