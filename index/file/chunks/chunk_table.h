// The tables of chunks in the file: the byte offsets of a layer's chunks, and their ranges of
// ranks.
//
// The chunks of a step are records, back to back, layer after layer, in the order of ChunkGrid:
// - the low 32 bits of XXH3 of the rest of the record
// - if the index has bricks: ChunkBricks
// - if it carries the values: a packed chunk (chunk_codec.h), but nothing if the same values are in
//   the record of an earlier step, which the table names, unless one value fills the chunk
// After the records comes a table for each layer: LayerHead, then a ChunkEntry for each chunk. In
// version 3 a ChunkEntry lacks `since`, and every record has its values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace isochron::index {

using RecordChecksum = std::uint32_t;

struct LayerHead {
    std::uint64_t checksum = 0; ///< XXH3 of the rest of the table
    std::uint64_t records = 0;  ///< byte offset of the layer's records from the start of the step
};

struct ChunkEntry {
    std::uint16_t bytes = 0; ///< size of its record
    /// Lowest and highest rank of its bricks; 255 and 0 if the chunk has no brick, 0 and 255 if the
    /// index has none.
    std::uint8_t low = 255, high = 0;
    /// The first step from which on the chunk has had these values without a break.
    std::uint32_t since = 0;
};
static_assert(sizeof(ChunkEntry) == 8);
/// Bytes of an entry of version 3.
constexpr std::size_t kEntryWithoutSince = 4;

constexpr std::uint64_t layer_table_bytes(std::uint32_t chunks, bool with_since = true) {
    return sizeof(LayerHead) +
           std::uint64_t{chunks} * (with_since ? sizeof(ChunkEntry) : kEntryWithoutSince);
}

RecordChecksum record_checksum(std::span<const std::byte> record);

} // namespace isochron::index
