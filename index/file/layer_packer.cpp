// Cuts a step into chunks and packs them.
#include "index/file/layer_packer.h"

#include "index/system/parallel.h"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

namespace isochron::index {
namespace {

/// Number of chunks that a thread packs at a time; it does not affect the file.
constexpr std::uint32_t kPlacesOfPiece = 32;

/// The bricks of the cells whose lowest vertex the chunk holds. @param bricks of the chunk's layer
ChunkBricks bricks_of_chunk(const BrickGrid& grid, std::uint32_t layers,
                            std::span<const std::uint8_t> bricks,
                            const std::array<std::uint32_t, 2>& chunk) {
    ChunkBricks out;
    std::fill_n(out.begin(), kBricksOfChunk, std::uint8_t{255});
    std::fill_n(out.begin() + kBricksOfChunk, kBricksOfChunk, std::uint8_t{0});
    constexpr std::size_t kOfLayer = std::size_t{kChunkBricks[0]} * kChunkBricks[1];
    const std::size_t count = std::size_t{grid.bricks()[0]} * grid.bricks()[1];
    for (std::uint32_t i = 0; i < kOfLayer; ++i)
        if (const auto brick = brick_of_chunk(grid, {chunk[0], chunk[1], 0}, i))
            for (std::size_t layer = 0; layer < layers; ++layer) {
                out[layer * kOfLayer + i] = bricks[2 * layer * count + *brick];
                out[kBricksOfChunk + layer * kOfLayer + i] =
                    bricks[(2 * layer + 1) * count + *brick];
            }
    return out;
}

/// Copies rows whose length is a compile-time constant, which is faster.
template <std::size_t kBytes>
void copy_rows(const std::byte* from, std::size_t row, std::size_t plane,
               const std::array<std::uint32_t, 3>& extent, std::byte* to) {
    for (std::uint32_t z = 0; z < extent[2]; ++z)
        for (std::uint32_t y = 0; y < extent[1]; ++y, to += kBytes)
            std::memcpy(to, from + z * plane + y * row, kBytes);
}

/// @param from the chunk's first value @param row bytes of a row of the step @param size of a value
void copy_chunk(const std::byte* from, std::size_t row, std::size_t plane,
                const std::array<std::uint32_t, 3>& extent, std::size_t size, std::byte* to) {
    const std::size_t bytes = extent[0] * size;
    switch (bytes) {
    case 16: return copy_rows<16>(from, row, plane, extent, to);
    case 32: return copy_rows<32>(from, row, plane, extent, to);
    case 64: return copy_rows<64>(from, row, plane, extent, to);
    case 128: return copy_rows<128>(from, row, plane, extent, to);
    default: break;
    }
    for (std::uint32_t z = 0; z < extent[2]; ++z)
        for (std::uint32_t y = 0; y < extent[1]; ++y, to += bytes)
            std::memcpy(to, from + z * plane + y * row, bytes);
}

} // namespace

RecordChecksum record_checksum(std::span<const std::byte> record) {
    return static_cast<RecordChecksum>(XXH3_64bits(record.data(), record.size()));
}

LayerPacker::LayerPacker(const Grid& grid, ValueType type, Codec codec, unsigned threads)
    : grid_(grid), type_(type), chunks_(grid) {
    for (unsigned i = 0; i < threads; ++i)
        packers_.emplace_back(codec);
    pieces_.resize((chunks_.chunks_of_layer() + kPlacesOfPiece - 1) / kPlacesOfPiece);
}

void LayerPacker::pack_chunk(const Layer& layer, std::uint32_t place, ChunkPacker& packer,
                             Piece& out, ChunkEntry& entry) const {
    const auto [x, y] = chunks_.at(place);
    const std::size_t begin = out.records.size();
    out.records.resize(begin + sizeof(RecordChecksum));
    entry = layer.with_bricks ? ChunkEntry{} : ChunkEntry{0, 0, 255};
    if (layer.with_bricks) {
        const ChunkBricks extremes =
            bricks_of_chunk(BrickGrid(grid_), layer.brick_layers, layer.bricks, {x, y});
        const auto bytes = std::as_bytes(std::span(extremes));
        out.records.insert(out.records.end(), bytes.begin(), bytes.end());
        entry.low = *std::min_element(extremes.begin(), extremes.begin() + kBricksOfChunk);
        entry.high = *std::max_element(extremes.begin() + kBricksOfChunk, extremes.end());
    }
    if (!layer.stored.empty()) {
        const std::size_t size = size_of(type_);
        const std::size_t row = grid_.vertices[0] * size, plane = grid_.vertices[1] * row;
        const auto extent = chunks_.size(packed_, place);
        out.values.resize(std::size_t{extent[0]} * extent[1] * extent[2] * size);
        copy_chunk(layer.stored.data() + y * kChunkEdge * row + x * kChunkEdge * size, row, plane,
                   extent, size, out.values.data());
        packer.pack(type_, extent, out.values, out.records);
    }
    const auto rest = std::span(out.records).subspan(begin + sizeof(RecordChecksum));
    const RecordChecksum checksum = record_checksum(rest);
    std::memcpy(out.records.data() + begin, &checksum, sizeof checksum);
    entry.bytes = static_cast<std::uint16_t>(out.records.size() - begin);
}

void LayerPacker::pack(const Layer& layer, const Append& append) {
    assert(packed_ < chunks_.layers());
    const std::uint32_t places = chunks_.chunks_of_layer();
    entries_.resize(places);
    parallel_for(pieces_.size(), static_cast<unsigned>(packers_.size()),
                 [&](std::size_t item, unsigned worker) {
                     Piece& piece = pieces_[item];
                     piece.records.clear();
                     const auto first = static_cast<std::uint32_t>(item) * kPlacesOfPiece;
                     for (std::uint32_t place = first;
                          place < std::min(first + kPlacesOfPiece, places); ++place)
                         pack_chunk(layer, place, packers_[worker], piece, entries_[place]);
                 },
                 {});
    const std::uint64_t table_bytes = layer_table_bytes(places);
    const std::size_t begin = tables_.size();
    tables_.resize(begin + table_bytes);
    std::byte* table = tables_.data() + begin;
    LayerHead head{0, end_};
    std::memcpy(table, &head, sizeof head);
    std::memcpy(table + sizeof head, entries_.data(), entries_.size() * sizeof(ChunkEntry));
    head.checksum = checksum_of({table + sizeof head.checksum, table_bytes - sizeof head.checksum});
    std::memcpy(table, &head, sizeof head);
    for (const Piece& piece : pieces_) {
        append(piece.records);
        end_ += piece.records.size();
    }
    ++packed_;
}

StepEntry LayerPacker::finish(const Append& append) {
    assert(packed_ == chunks_.layers());
    append(tables_);
    const StepEntry entry{.offset = 0, .bytes = end_ + tables_.size(), .tables = end_};
    tables_.clear();
    packed_ = 0;
    end_ = 0;
    return entry;
}

} // namespace isochron::index
