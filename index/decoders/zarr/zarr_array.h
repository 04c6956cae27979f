// One array of a Zarr hierarchy, of version 2 or 3: its description, and its chunks as values.
#pragma once

#include "index/decoders/zarr/zarr_cache.h"
#include "index/decoders/zarr/zarr_codecs.h"
#include "index/formats/stored_scalar.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::index {

/// Zarr v2: https://zarr.readthedocs.io/en/stable/spec/v2.html; v3:
/// https://zarr-specs.readthedocs.io/en/latest/v3/core/, sharding codec included.
class ZarrArray {
  public:
    /// @param path in the store; empty for its root @return empty if there is no array
    /// @throws Error naming store and array: damaged, or it uses a feature that is not supported
    static std::optional<ZarrArray> open(const ZarrStore& store, const std::string& path);

    const std::string& path() const { return path_; }
    /// The type of the values; empty if no volume can have it.
    std::optional<StoredType> type() const { return type_; }
    const std::vector<std::uint64_t>& shape() const { return shape_; }
    /// Number of values along each dimension of a chunk, or, if chunks are shards, of its parts.
    const std::vector<std::uint64_t>& chunk() const { return inner_.empty() ? chunk_ : inner_; }
    /// Names of the dimensions; empty if the array does not give them.
    const std::vector<std::string>& names() const { return names_; }
    const nlohmann::json& attributes() const { return attributes_; }
    /// The value of chunks that were never written, where the description has one.
    std::optional<double> fill() const { return fill_number_; }
    /// Whether files hold the chunks as they are in memory, so that a part can be read alone.
    bool plain() const {
        return inner_.empty() && pipeline_.codecs.empty() && pipeline_.order.empty() &&
               !pipeline_.big_endian;
    }

    /// Whether a chunk spans these dimensions, and is large, but small enough to be kept: pieces of
    /// it then need less room beside it than all of it.
    bool keeps_whole(std::span<const std::size_t> dimensions) const;

    /// The box of values from `start`, `count` along each dimension, as stored, in the machine's
    /// byte order, the last dimension fastest. @throws Error naming the chunk that is damaged
    void read(std::span<const std::uint64_t> start, std::span<const std::uint64_t> count,
              std::span<std::byte> out);

  private:
    /// How the bytes of a chunk are turned into values.
    struct Pipeline {
        std::vector<ZarrCodec> codecs; ///< in the order of decoding
        bool big_endian = false;
        std::vector<std::size_t> order; ///< of the dimensions as stored; empty: as they are
    };
    /// Where the chunks of a shard lie.
    struct ShardIndex {
        ZarrBytes entries = {};  ///< offset and size of each chunk; empty: there is no shard
        std::uint64_t bytes = 0; ///< of the whole shard
    };
    ZarrArray(const ZarrStore& store, std::string path) : store_(&store), path_(std::move(path)) {}

    /// @throws Error when a number is not whole, or negative
    std::vector<std::size_t> lengths_in(const nlohmann::json& list) const;
    void describe_v2(const nlohmann::json& j);
    void describe_v3(const nlohmann::json& j);
    Pipeline pipeline_v3(const nlohmann::json& codecs, bool outer);
    void take_shard(const nlohmann::json& configuration);
    void check() const;
    void fill_with(const nlohmann::json& value);
    std::string where(const std::string& what) const;
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
    void decode_chunk(const std::string& name, ZarrBytes& values);
    void transpose(const ZarrBytes& stored, ZarrBytes& out) const;

    const ZarrStore* store_;
    std::string path_;
    std::optional<StoredType> type_;
    std::vector<std::uint64_t> shape_, chunk_, inner_; ///< of chunks in a shard, if there are
    std::vector<std::string> names_;
    nlohmann::json attributes_;
    std::string prefix_, separator_ = ".";
    Pipeline pipeline_, index_;
    bool index_at_end_ = true;
    ZarrBytes fill_; ///< one value
    std::optional<double> fill_number_;
    static constexpr std::size_t kKept = std::size_t{256} << 20, kLarge = std::size_t{64} << 20;
    ZarrCache<ZarrBytes> kept_{kKept};
    ZarrCache<ShardIndex> shards_{std::size_t{64} << 20};
    ZarrBytes chunk_values_, spare_; ///< their memory is used again
};

} // namespace isochron::index
