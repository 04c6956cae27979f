// One array of a Zarr hierarchy, of version 2 or 3: its description, and its chunks as values.
#pragma once

#include "index/readers/decoders/zarr/zarr_cache.h"
#include "index/readers/decoders/zarr/zarr_description.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace isochron::index {

class ZarrArray {
  public:
    /// @param path in the store; empty for its root @return empty if there is no array
    /// @throws Error as `description_of_zarr` does
    static std::optional<ZarrArray> open(const ZarrStore& store, const std::string& path);

    const std::string& path() const { return said_.path; }
    /// The type of the values; empty if no volume can have it.
    std::optional<StoredType> type() const { return said_.type; }
    const std::vector<std::uint64_t>& shape() const { return said_.shape; }
    /// Number of values along each dimension of a chunk, or, if chunks are shards, of its parts.
    const std::vector<std::uint64_t>& chunk() const { return said_.parts(); }
    /// Names of the dimensions; empty if the array does not give them.
    const std::vector<std::string>& names() const { return said_.names; }
    const nlohmann::json& attributes() const { return said_.attributes; }
    /// The value of chunks that were never written, where the description has one.
    std::optional<double> fill() const { return said_.fill_number; }
    /// Whether files hold the chunks as they are in memory, so that a part can be read alone.
    bool plain() const {
        return said_.inner.empty() && said_.pipeline.codecs.empty() &&
               said_.pipeline.order.empty() && !said_.pipeline.big_endian && !said_.half;
    }
    /// Whether values are stored as float16.
    bool half() const { return said_.half; }
    const std::string& type_name() const { return said_.type_name; }

    /// @throws Error naming the codec that is not known
    void expect_known_codecs() const;

    /// Whether a chunk spans these dimensions, and is large, but small enough to be kept: then it
    /// takes less memory to copy pieces out of the kept chunk than to copy all of it.
    bool keeps_whole(std::span<const std::size_t> dimensions) const;

    /// The texts of a short array of one dimension, or of none: dates as ISO 8601 has them, of UTC.
    /// Empty: it holds none. @throws Error as `read` does
    std::vector<std::string> texts();

    /// The box of values from `start`, `count` along each dimension, as stored, in the machine's
    /// byte order, the last dimension fastest. @throws Error naming the chunk that is damaged, or the
    /// codec that is not known
    void read(std::span<const std::uint64_t> start, std::span<const std::uint64_t> count,
              std::span<std::byte> out);

  private:
    /// Where the chunks of a shard lie.
    struct ShardIndex {
        ZarrBytes entries = {};  ///< offset and size of each chunk; empty: there is no shard
        std::uint64_t bytes = 0; ///< size of the whole shard
    };
    ZarrArray(const ZarrStore& store, ZarrDescription said)
        : store_(&store), said_(std::move(said)) {}

    std::string key_of(std::span<const std::uint64_t> at) const;
    std::size_t values_in_chunk() const;
    /// The values of a chunk; empty: only the fill value.
    const ZarrBytes& chunk_at(const std::vector<std::uint64_t>& at);
    void load(const std::vector<std::uint64_t>& at, ZarrBytes& values);
    bool load_part(const std::vector<std::uint64_t>& at, std::size_t first,
                   std::span<std::byte> values) const;
    void read_from_chunk(const std::vector<std::uint64_t>& at, std::span<const std::uint64_t> start,
                         std::span<const std::uint64_t> count, std::span<std::byte> out);
    void load_from_shard(const std::vector<std::uint64_t>& at, ZarrBytes& values);
    const ShardIndex& index_of_shard(const std::vector<std::uint64_t>& shard,
                                     const std::string& key, const std::string& name);
    std::vector<std::string> texts_in(const ZarrBytes& chunk, const std::string& name) const;
    void decode_chunk(const std::string& name, ZarrBytes& values);
    void transpose(const ZarrBytes& stored, ZarrBytes& out) const;

    const ZarrStore* store_;
    ZarrDescription said_;
    static constexpr std::size_t kKept = std::size_t{256} << 20, kLarge = std::size_t{64} << 20,
                                 kMostTexts = std::size_t{16} << 20; ///< bytes of a chunk
    ZarrCache<ZarrBytes> kept_{kKept};
    ZarrCache<ShardIndex> shards_{std::size_t{64} << 20};
    ZarrBytes chunk_values_, spare_; ///< their memory is used again
};

} // namespace isochron::index
