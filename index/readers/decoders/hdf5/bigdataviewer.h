// BigDataViewer's HDF5: views by time point, setup and level, which the .xml beside it places.
#pragma once

#include "index/readers/decoders/hdf5/hdf5_file.h"
#include "index/readers/formats/stated/stated_array.h"

#include <string>
#include <vector>

namespace isochron::index {

bool is_bigdataviewer(const Hdf5File& file);

/// The finest level of the only setup, at all times: `/t*/s00/0/cells`.
/// @throws Error naming the arrays of the setups where there are several
std::string view_of_bigdataviewer(const Hdf5File& file);

/// Takes the places of a level from the size of its setup's voxels, as `SpimData` in the .xml of the
/// file's name has it, and from the level's resolution.
/// @param view such as `/t00000/s01/2/cells`; other datasets are left as they are
/// @param array its record
void take_bigdataviewer(const Hdf5File& file, const Hdf5Dataset& view, StatedArray& array,
                        std::vector<std::string>& notes);

} // namespace isochron::index
