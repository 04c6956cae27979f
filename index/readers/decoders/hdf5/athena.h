// Blocks of a mesh as Athena++ writes them.
#pragma once

#include "index/readers/decoders/decoded_file.h"
#include "index/readers/decoders/hdf5/hdf5_file.h"
#include "index/volume/volume_series.h"

#include <memory>

namespace isochron::index {

bool is_athena(const Hdf5File& file);

/// Puts the blocks of an output together, whose values are those of cells, taken at their centers.
/// @throws Error naming the file: blocks of several levels, missing blocks, no such variable
std::unique_ptr<DecodedFile> decode_athena(std::unique_ptr<Hdf5File> file,
                                           const ReadOptions& options);

} // namespace isochron::index
