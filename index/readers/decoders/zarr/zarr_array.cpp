// Chunks of Zarr arrays, which may lie in shards.
#include "index/readers/decoders/zarr/zarr_array.h"

#include "index/error.h"
#include "index/readers/formats/half_float.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace isochron::index {

std::optional<ZarrArray> ZarrArray::open(const ZarrStore& store, const std::string& path) {
    auto said = description_of_zarr(store, path);
    return said ? std::optional(ZarrArray(store, std::move(*said))) : std::nullopt;
}

bool ZarrArray::keeps_whole(std::span<const std::size_t> dimensions) const {
    const std::size_t bytes = said_.type ? values_in_chunk() * size_of(*said_.type) : 0;
    return bytes > kLarge && bytes <= kKept && std::ranges::all_of(dimensions, [&](std::size_t i) {
               return chunk()[i] >= said_.shape[i];
           });
}

std::string ZarrArray::key_of(std::span<const std::uint64_t> at) const {
    std::string key = said_.prefix;
    for (const std::uint64_t number : at)
        key += (key.empty() ? "" : said_.separator) + std::to_string(number);
    return zarr_key(said_.path, at.empty() && key.empty() ? "0" : key);
}

std::size_t ZarrArray::values_in_chunk() const {
    std::size_t values = 1;
    for (const std::uint64_t length : chunk())
        values *= length;
    return values;
}

/// Makes values of stored bytes.
void ZarrArray::decode_chunk(const std::string& name, ZarrBytes& values) {
    const bool vary = said_.texts == ZarrTexts::varying;
    const std::size_t size = said_.element(), bytes = vary ? kMostTexts : values_in_chunk() * size;
    // A check adds to what comes out of the codecs before it.
    constexpr std::size_t kSlack = 64;
    for (const ZarrCodec& codec : said_.pipeline.codecs)
        decode(codec, bytes + kSlack, name, values, spare_);
    if (spare_.capacity() > kLarge)
        spare_ = {};
    if (vary)
        return;
    if (values.size() != bytes)
        throw Error("{}: {} bytes, expected {}", name, values.size(), bytes);
    if (said_.pipeline.big_endian && said_.texts != ZarrTexts::bytes)
        swap_bytes(std::as_writable_bytes(std::span(values)),
                   said_.texts == ZarrTexts::utf32 ? 4 : size);
    if (!said_.pipeline.order.empty()) {
        transpose(values, spare_);
        values.swap(spare_);
    }
    if (!said_.half)
        return;
    spare_.resize(2 * bytes);
    widen_halves(values, spare_);
    values.swap(spare_);
}

/// Stored dimension i is dimension order[i]: walks through the values as they are stored.
void ZarrArray::transpose(const ZarrBytes& stored, ZarrBytes& out) const {
    const std::size_t rank = chunk().size(), size = said_.element(), bytes = stored.size();
    const std::vector<std::size_t>& order = said_.pipeline.order;
    std::vector<std::size_t> stride(rank, 1), at(rank, 0);
    for (std::size_t i = rank - 1; i-- > 0;)
        stride[i] = stride[i + 1] * chunk()[i + 1];
    out.resize(bytes);
    for (std::size_t from = 0; from < bytes; from += size) {
        std::size_t to = 0;
        for (std::size_t i = 0; i < rank; ++i)
            to += at[i] * stride[order[i]];
        std::memcpy(&out[to * size], &stored[from], size);
        for (std::size_t i = rank; i-- > 0;) {
            if (++at[i] < chunk()[order[i]])
                break;
            at[i] = 0;
        }
    }
}

/// @param values empty: only the fill value
void ZarrArray::load(const std::vector<std::uint64_t>& at, ZarrBytes& values) {
    if (!said_.inner.empty())
        return load_from_shard(at, values);
    const std::string key = key_of(at);
    if (store_->read(key, values))
        decode_chunk(fmt::format("{}: {}", store_->name(), key), values);
    else
        values.clear();
}

/// Some values of a chunk that is stored as it is.
/// @param first of the values in the chunk @return false where there is no such chunk
bool ZarrArray::load_part(const std::vector<std::uint64_t>& at, std::size_t first,
                          std::span<std::byte> values) const {
    const std::string key = key_of(at);
    const std::size_t size = size_of(*said_.type), bytes = values_in_chunk() * size;
    const auto stored = store_->size_of_value(key);
    if (!stored)
        return false;
    if (*stored != bytes)
        throw Error("{}: {}: {} bytes, expected {}", store_->name(), key, *stored, bytes);
    store_->part(key, first * size, values);
    return true;
}

const ZarrBytes& ZarrArray::chunk_at(const std::vector<std::uint64_t>& at) {
    if (const ZarrBytes* found = kept_.find(at))
        return *found;
    kept_.make_room(values_in_chunk() * size_of(*said_.type));
    ZarrBytes values;
    load(at, values);
    const std::size_t bytes = values.size();
    return kept_.keep(at, std::move(values), bytes);
}

void ZarrArray::expect_known_codecs() const {
    if (!said_.unread.empty())
        throw Error(said_.unread);
}

void ZarrArray::read(std::span<const std::uint64_t> start, std::span<const std::uint64_t> count,
                     std::span<std::byte> out) {
    expect_known_codecs();
    const std::size_t rank = said_.shape.size();
    std::vector<std::uint64_t> first(rank), last(rank), at;
    for (std::size_t i = 0; i < rank; ++i) {
        first[i] = start[i] / chunk()[i];
        last[i] = (start[i] + count[i] - 1) / chunk()[i];
    }
    at = first;
    while (true) {
        read_from_chunk(at, start, count, out);
        std::size_t i = rank;
        while (i > 0 && ++at[i - 1] > last[i - 1]) {
            at[i - 1] = first[i - 1];
            --i;
        }
        if (i == 0)
            return;
    }
}

/// The part of the box that lies in this chunk.
void ZarrArray::read_from_chunk(const std::vector<std::uint64_t>& at,
                                std::span<const std::uint64_t> start,
                                std::span<const std::uint64_t> count, std::span<std::byte> out) {
    const std::size_t rank = said_.shape.size(), size = size_of(*said_.type);
    std::vector<std::uint64_t> low(rank), high(rank);
    std::size_t wanted = 1;
    bool all = true;
    for (std::size_t i = 0; i < rank; ++i) {
        low[i] = std::max(start[i], at[i] * chunk()[i]);
        high[i] = std::min(start[i] + count[i], (at[i] + 1) * chunk()[i]);
        wanted *= high[i] - low[i];
        all = all && high[i] - low[i] ==
                         std::min(chunk()[i],
                                  said_.shape[i] - std::min(said_.shape[i], at[i] * chunk()[i]));
    }
    const auto place_in_chunk = [&](std::span<const std::uint64_t> p, std::uint64_t off) {
        std::size_t place = 0;
        for (std::size_t i = 0; i < rank; ++i)
            place = place * chunk()[i] + (p[i] - off - at[i] * chunk()[i]);
        return place;
    };
    const auto place_in_box = [&](std::span<const std::uint64_t> p, std::uint64_t off) {
        std::size_t place = 0;
        for (std::size_t i = 0; i < rank; ++i)
            place = place * count[i] + (p[i] - off - start[i]);
        return place;
    };
    // Values that lie in one piece both in the box and in a plain chunk are read straight into the
    // box.
    const std::size_t from_low = place_in_chunk(low, 0), to_low = place_in_box(low, 0);
    const std::size_t stretch = place_in_chunk(high, 1) + 1 - from_low;
    if (plain() && stretch == wanted && place_in_box(high, 1) + 1 - to_low == wanted &&
        load_part(at, from_low, out.subspan(to_low * size, wanted * size)))
        return;
    // A chunk that is wanted as a whole need not be kept: nothing of it is left to ask for. Of a
    // plain chunk only the wanted values are read.
    const std::size_t begin = all || !plain() ? 0 : from_low;
    if (all) {
        load(at, chunk_values_);
    } else if (plain()) {
        chunk_values_.resize(stretch * size);
        if (!load_part(at, begin, chunk_values_))
            chunk_values_.clear();
    }
    const ZarrBytes& values = all || plain() ? chunk_values_ : chunk_at(at);
    const std::size_t row = high[rank - 1] - low[rank - 1];
    for (std::vector<std::uint64_t> p = low;;) { // row by row along the last dimension
        const std::size_t to = place_in_box(p, 0), from = place_in_chunk(p, 0) - begin;
        if (!values.empty())
            std::memcpy(&out[to * size], &values[from * size], row * size);
        else
            for (std::size_t i = 0; i < row; ++i)
                std::memcpy(&out[(to + i) * size], said_.fill.data(), size);
        std::size_t i = rank - 1;
        while (i > 0 && ++p[i - 1] >= high[i - 1]) {
            p[i - 1] = low[i - 1];
            --i;
        }
        if (i == 0)
            return;
    }
}

void ZarrArray::load_from_shard(const std::vector<std::uint64_t>& at, ZarrBytes& values) {
    values.clear();
    std::vector<std::uint64_t> shard;
    std::size_t number = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
        const std::uint64_t along = said_.chunk[i] / said_.inner[i];
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
        throw Error("{}: truncated: chunk {} of {} bytes at {} of {}", name, number, entry[1],
                    entry[0], index.bytes);
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
        if (__builtin_mul_overflow(count, said_.chunk[i] / said_.inner[i], &count) ||
            count > *bytes)
            throw Error("{}: {} bytes, expected an index of {} x {} chunks", name, *bytes, count,
                        said_.chunk[i] / said_.inner[i]);
    std::size_t size = 16 * count;
    for (const ZarrCodec& codec : said_.index.codecs)
        size += codec.name == "crc32c" ? 4 : 0;
    if (*bytes < size)
        throw Error("{}: {} bytes, expected an index of {}", name, *bytes, size);
    index.bytes = *bytes;
    index.entries.resize(size);
    store_->part(key, said_.index_at_end ? *bytes - size : 0, index.entries);
    for (const ZarrCodec& codec : said_.index.codecs)
        decode(codec, size, name, index.entries, spare_);
    if (index.entries.size() != 16 * count)
        throw Error("{}: an index of {} bytes, expected {}", name, index.entries.size(),
                    16 * count);
    const std::size_t kept = index.entries.size();
    return shards_.keep(shard, std::move(index), kept);
}

} // namespace isochron::index
