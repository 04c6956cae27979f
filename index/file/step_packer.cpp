// Cutting a step into chunks and packing them.
#include "index/file/step_packer.h"

#include "index/file/chunk_table.h"
#include "index/system/parallel.h"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace isochron::index {
namespace {

void append_bytes(std::vector<std::byte>& out, std::span<const std::byte> bytes) {
    out.insert(out.end(), bytes.begin(), bytes.end());
}

/// Of the cells whose lowest vertex the chunk holds. @param bricks of the whole step
ChunkBricks bricks_of_chunk(const BrickGrid& grid, std::span<const std::uint8_t> bricks,
                            const std::array<std::uint32_t, 3>& chunk) {
    ChunkBricks out;
    std::fill_n(out.begin(), kBricksOfChunk, std::uint8_t{255});
    std::fill_n(out.begin() + kBricksOfChunk, kBricksOfChunk, std::uint8_t{0});
    for (std::uint32_t i = 0; i < kBricksOfChunk; ++i)
        if (const auto brick = brick_of_chunk(grid, chunk, i)) {
            out[i] = bricks[*brick];
            out[kBricksOfChunk + i] = bricks[grid.count() + *brick];
        }
    return out;
}

} // namespace

RecordChecksum record_checksum(std::span<const std::byte> record) {
    return static_cast<RecordChecksum>(XXH3_64bits(record.data(), record.size()));
}

struct StepPacker::Layer {
    std::vector<std::byte> records;
    std::vector<ChunkEntry> entries;
};

StepPacker::StepPacker(const Grid& grid, ValueType type, Codec codec, unsigned threads)
    : grid_(grid), type_(type), chunks_(grid) {
    for (unsigned i = 0; i < threads; ++i)
        packers_.emplace_back(codec);
}

void StepPacker::pack_layer(std::span<const std::byte> stored, std::span<const std::uint8_t> bricks,
                            std::uint32_t layer, ChunkPacker& packer, Layer& out) const {
    const BrickGrid brick_grid(grid_);
    const std::size_t size = size_of(type_);
    const std::size_t row = grid_.vertices[0] * size, plane = grid_.vertices[1] * row;
    std::vector<std::byte> values;
    out.records.clear();
    out.entries.assign(chunks_.chunks_of_layer(),
                       bricks.empty() ? ChunkEntry{0, 0, 255} : ChunkEntry{});
    for (std::uint32_t place = 0; place < chunks_.chunks_of_layer(); ++place) {
        const auto [x, y] = chunks_.at(place);
        const std::size_t begin = out.records.size();
        out.records.resize(begin + sizeof(RecordChecksum));
        ChunkEntry& entry = out.entries[place];
        if (!bricks.empty()) {
            const ChunkBricks extremes = bricks_of_chunk(brick_grid, bricks, {x, y, layer});
            append_bytes(out.records, std::as_bytes(std::span(extremes)));
            entry.low = *std::min_element(extremes.begin(), extremes.begin() + kBricksOfChunk);
            entry.high = *std::max_element(extremes.begin() + kBricksOfChunk, extremes.end());
        }
        if (!stored.empty()) {
            const auto extent = chunks_.size(layer, place);
            values.clear();
            for (std::uint32_t dz = 0; dz < extent[2]; ++dz)
                for (std::uint32_t dy = 0; dy < extent[1]; ++dy)
                    append_bytes(values, stored.subspan((layer * kChunkEdge + dz) * plane +
                                                            (y * kChunkEdge + dy) * row +
                                                            x * kChunkEdge * size,
                                                        extent[0] * size));
            packer.pack(type_, extent, values, out.records);
        }
        const auto rest = std::span(out.records).subspan(begin + sizeof(RecordChecksum));
        const RecordChecksum checksum = record_checksum(rest);
        std::memcpy(out.records.data() + begin, &checksum, sizeof checksum);
        entry.bytes = static_cast<std::uint16_t>(out.records.size() - begin);
    }
}

StepEntry StepPacker::pack(std::span<const std::byte> stored, std::span<const std::uint8_t> bricks,
                           const Append& append) {
    const auto threads = static_cast<unsigned>(packers_.size());
    const std::uint64_t table_bytes = layer_table_bytes(chunks_.chunks_of_layer());
    std::vector<std::byte> tables(table_bytes * chunks_.layers());
    std::vector<Layer> batch(threads);
    std::uint64_t end = 0;
    for (std::uint32_t first = 0; first < chunks_.layers(); first += threads) {
        const std::uint32_t count = std::min(threads, chunks_.layers() - first);
        parallel_for(count, threads,
                     [&](std::size_t item, unsigned worker) {
                         pack_layer(stored, bricks, first + static_cast<std::uint32_t>(item),
                                    packers_[worker], batch[item]);
                     },
                     {});
        for (std::uint32_t item = 0; item < count; ++item) {
            const Layer& layer = batch[item];
            std::byte* table = tables.data() + (first + item) * table_bytes;
            LayerHead head{0, end};
            std::memcpy(table, &head, sizeof head);
            std::memcpy(table + sizeof head, layer.entries.data(),
                        layer.entries.size() * sizeof(ChunkEntry));
            head.checksum =
                checksum_of({table + sizeof head.checksum, table_bytes - sizeof head.checksum});
            std::memcpy(table, &head, sizeof head);
            append(layer.records);
            end += layer.records.size();
        }
    }
    append(tables);
    return {.offset = 0, .bytes = end + tables.size(), .tables = end};
}

} // namespace isochron::index
