// What an array of a Zarr hierarchy, of version 2 or 3, says of itself.
#pragma once

#include "index/readers/decoders/zarr/zarr_codecs.h"
#include "index/readers/decoders/zarr/zarr_store.h"
#include "index/readers/formats/stored_scalar.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace isochron::index {

/// How the bytes of a chunk are turned into values.
struct ZarrPipeline {
    std::vector<ZarrCodec> codecs; ///< in the order of decoding
    bool big_endian = false;
    std::vector<std::size_t> order; ///< order of the dimensions as stored; empty: as they are
};

/// How an array holds texts, or dates.
enum class ZarrTexts : std::uint8_t { none, bytes, utf32, varying, dates };

struct ZarrDescription {
    std::string path;               ///< in the store; empty for its root
    std::optional<StoredType> type; ///< type of the values; empty if no volume can have it
    bool half = false;              ///< stored as float16, of type f32
    std::string type_name;          ///< as the array has it
    ZarrTexts texts = ZarrTexts::none;
    std::size_t text_bytes = 0;   ///< size of one of them as stored; 0: they vary
    std::string date_unit;        ///< unit of dates: `ns`, as NumPy has it
    std::int64_t date_factor = 1; ///< by which their numbers count it
    std::string unread;           ///< why its chunks cannot be read; empty: they can
    std::vector<std::uint64_t> shape, chunk, inner; ///< inner: of chunks in a shard, if there are
    /// Names of the dimensions; empty if the array does not give them.
    std::vector<std::string> names;
    nlohmann::json attributes;
    /// How the keys of chunks begin, and what stands between their numbers.
    std::string prefix, separator = ".";
    ZarrPipeline pipeline, index;      ///< how chunks, and the index of a shard, are decoded
    bool index_at_end = true;          ///< where the index of a shard stands
    ZarrBytes fill;                    ///< one value
    std::optional<double> fill_number; ///< if there is one

    /// Bytes of a stored value.
    std::size_t element() const {
        return half ? 2 : type ? size_of(*type) : std::max<std::size_t>(text_bytes, 1);
    }
    /// Number of values along each dimension of a chunk, or, if chunks are shards, of its parts.
    const std::vector<std::uint64_t>& parts() const { return inner.empty() ? chunk : inner; }
};

/// Zarr v2: https://zarr.readthedocs.io/en/stable/spec/v2.html; v3:
/// https://zarr-specs.readthedocs.io/en/latest/v3/core/, sharding codec included.
/// @param path in the store; empty for its root @return empty if there is no array
/// @throws Error naming store and array: damaged
std::optional<ZarrDescription> description_of_zarr(const ZarrStore& store, const std::string& path);

/// The key of something in a group; the root's key is empty.
std::string zarr_key(const std::string& group, const std::string& name);

} // namespace isochron::index
