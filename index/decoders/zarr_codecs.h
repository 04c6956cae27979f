// What Zarr's chunks went through: compressors and filters of versions 2 and 3.
#pragma once

#include "index/decoders/zarr_store.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace isochron::index {

/// A step from stored bytes towards values: `gzip`, `zstd`, `blosc`, `crc32c`, ...
struct ZarrCodec {
    std::string name;
    std::size_t element = 1; ///< [bytes], of `shuffle`
};

/// The codec as its description has it. @param element [bytes] of a value
/// @throws Error naming the array, for one that is not known
ZarrCodec codec_of(const std::string& name, std::size_t element, const std::string& array);

/// @param bytes that the result has; 0: as many as come out
/// @param most [bytes] that may come out
/// @throws Error naming the chunk: damaged, of another size
ZarrBytes decoded(ZarrBytes stored, const ZarrCodec& codec, std::size_t bytes, std::size_t most,
                  const std::string& chunk);

} // namespace isochron::index
