// Chunks of Zarr arrays that lie in shards.
#include "index/decoders/zarr/zarr_array.h"
#include "index/error.h"

#include <fmt/format.h>

#include <cstring>

namespace isochron::index {

void ZarrArray::load_from_shard(const std::vector<std::uint64_t>& at, ZarrBytes& values) {
    values.clear();
    std::vector<std::uint64_t> shard;
    std::size_t number = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
        const std::uint64_t along = chunk_[i] / inner_[i];
        shard.push_back(at[i] / along);
        number = number * along + at[i] % along;
    }
    const std::string key = key_of(shard), name = fmt::format("{}: {}", store_->name(), key);
    const ShardIndex& index = index_of_shard(shard, key, name);
    if (index.entries.empty())
        return;
    std::uint64_t entry[2]{};
    std::memcpy(entry, &index.entries[16 * number], sizeof entry);
    constexpr std::uint64_t kNone = ~std::uint64_t{0};
    if (entry[0] == kNone && entry[1] == kNone)
        return;
    if (entry[0] > index.bytes || entry[1] > index.bytes - entry[0])
        throw Error(fmt::format("{}: truncated: chunk {} of {} bytes at {} of {}", name, number,
                                entry[1], entry[0], index.bytes));
    values.resize(entry[1]);
    store_->part(key, entry[0], values);
    decode_chunk(name, values);
}

// Behind or before its chunks a shard has, for each, where it begins and its bytes (u64 each).
const ZarrArray::ShardIndex& ZarrArray::index_of_shard(const std::vector<std::uint64_t>& shard,
                                                       const std::string& key,
                                                       const std::string& name) {
    if (const ShardIndex* found = shards_.find(shard))
        return *found;
    ShardIndex index;
    const auto bytes = store_->size_of_value(key);
    if (!bytes)
        return shards_.keep(shard, std::move(index), 0);
    std::size_t count = 1;
    for (std::size_t i = 0; i < shard.size(); ++i)
        if (__builtin_mul_overflow(count, chunk_[i] / inner_[i], &count) || count > *bytes)
            throw Error(fmt::format("{}: {} bytes, expected an index of {} x {} chunks", name,
                                    *bytes, count, chunk_[i] / inner_[i]));
    std::size_t size = 16 * count;
    for (const ZarrCodec& codec : index_.codecs)
        size += codec.name == "crc32c" ? 4 : 0;
    if (*bytes < size)
        throw Error(fmt::format("{}: {} bytes, expected an index of {}", name, *bytes, size));
    index.bytes = *bytes;
    index.entries.resize(size);
    store_->part(key, index_at_end_ ? *bytes - size : 0, index.entries);
    for (const ZarrCodec& codec : index_.codecs)
        decode(codec, size, name, index.entries, spare_);
    if (index.entries.size() != 16 * count)
        throw Error(fmt::format("{}: an index of {} bytes, expected {}", name, index.entries.size(),
                                16 * count));
    const std::size_t kept = index.entries.size();
    return shards_.keep(shard, std::move(index), kept);
}

} // namespace isochron::index
