// The compressors and filters of Zarr's chunks, versions 2 and 3.
#pragma once

#include "index/readers/decoders/zarr/zarr_store.h"

#include <cstddef>
#include <string>

namespace isochron::index {

/// A step from stored bytes towards values: `gzip`, `zstd`, `blosc`, `crc32c`, ...
struct ZarrCodec {
    std::string name;
    std::size_t element = 1; ///< [bytes], of `shuffle`
};

/// The codec as its description has it. @param element [bytes] of a value
/// @throws Error naming the array, for one that is not known
ZarrCodec codec_of(const std::string& name, std::size_t element, const std::string& array);

/// Takes one step from stored bytes towards values.
/// @param most [bytes] that may come out
/// @param bytes input, replaced by the output
/// @param spare a buffer that may be used
/// @throws Error naming the chunk: damaged, or more comes out
void decode(const ZarrCodec& codec, std::size_t most, const std::string& chunk, ZarrBytes& bytes,
            ZarrBytes& spare);

} // namespace isochron::index
