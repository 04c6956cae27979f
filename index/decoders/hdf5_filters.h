// Filters that HDF5 has to be taught: those that h5py and others write without asking.
#pragma once

namespace isochron::index {

/// LZF, Zstandard and, where it was built with the library, Blosc; to decompress. Others are found
/// as plugins.
void register_hdf5_filters();

} // namespace isochron::index
