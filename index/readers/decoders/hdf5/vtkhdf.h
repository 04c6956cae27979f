// VTKHDF: image data in HDF5, as VTK 9.2 and later write it.
#pragma once

#include "index/readers/decoders/decoded_file.h"
#include "index/readers/decoders/hdf5/hdf5_file.h"

#include <memory>

namespace isochron::index {

bool is_vtkhdf(const Hdf5File& file);

/// Image data of one step or several (`Steps`); point and cell data.
/// @throws Error naming the file: another type of data, damaged, several arrays and none chosen
std::unique_ptr<DecodedFile> decode_vtkhdf(std::unique_ptr<Hdf5File> file,
                                           const ReadOptions& options);

} // namespace isochron::index
