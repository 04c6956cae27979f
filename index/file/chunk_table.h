// Where the chunks of a layer lie, and between which ranks their values are.
//
// The chunks of a step are records, back to back, layer after layer, in the order of ChunkGrid:
// - XXH3 of the rest of the record, its low 32 bits
// - where the index has bricks: ChunkBricks
// - where it carries the values: a packed chunk (chunk_codec.h)
// Behind them, a table for each layer: LayerHead, then a ChunkEntry for each chunk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace isochron::index {

using RecordChecksum = std::uint32_t;

struct LayerHead {
    std::uint64_t checksum = 0; ///< XXH3 of the rest of the table
    std::uint64_t records = 0;  ///< where those of the layer begin, from the start of the step
};

struct ChunkEntry {
    std::uint16_t bytes = 0; ///< of its record
    /// Lowest and highest rank of its bricks; 255 and 0 where it has none, 0 and 255 in an index
    /// without bricks.
    std::uint8_t low = 255, high = 0;
};
static_assert(sizeof(ChunkEntry) == 4);

constexpr std::uint64_t layer_table_bytes(std::uint32_t chunks) {
    return sizeof(LayerHead) + std::uint64_t{chunks} * sizeof(ChunkEntry);
}

RecordChecksum record_checksum(std::span<const std::byte> record);

} // namespace isochron::index
