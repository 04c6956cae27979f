// Registers HDF5 filters that the library does not have, but that h5py and others write.
#pragma once

namespace isochron::index {

/// Registers decompression of LZF, Zstandard and, if the build has its library, Blosc. HDF5 finds
/// other filters as plugins.
void register_hdf5_filters();

} // namespace isochron::index
