// Cuts a step into chunks and packs them.
#include "index/file/chunks/layer_packer.h"

#include "index/system/parallel.h"

#include <xxhash.h>

#include <algorithm>
#include <cassert>
#include <cstring>

namespace isochron::index {
namespace {

/// Number of chunks that a thread packs at a time; it does not affect the file.
constexpr std::uint32_t kPlacesOfPiece = 32;
/// Values that are taken out of a layer together, which stay in the cache until they are packed.
constexpr std::size_t kBytesTogether = 128 << 10;

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

/// Chunks next to each other along x: where their values go.
struct Neighbors {
    static constexpr std::size_t kMost = 8;
    std::array<std::byte*, kMost> to;
    std::size_t count = 0;
};

/// Copies the chunks row by row, so that a cache line of the step that holds rows of several chunks
/// is read once. @param width bytes of a row of a chunk, a compile-time constant
template <std::size_t kWidth>
void copy_rows_of(const std::byte* from, std::size_t row, std::size_t plane,
                  const std::array<std::uint32_t, 3>& extent, const Neighbors& chunks) {
    std::size_t at = 0;
    for (std::uint32_t z = 0; z < extent[2]; ++z)
        for (std::uint32_t y = 0; y < extent[1]; ++y, at += kWidth)
            for (std::size_t i = 0; i < chunks.count; ++i)
                std::memcpy(chunks.to[i] + at, from + z * plane + y * row + i * kWidth, kWidth);
}

/// @param from the first chunk's first value @param row bytes of a row of the step
/// @param extent of each chunk @param size of a value
void copy_chunks(const std::byte* from, std::size_t row, std::size_t plane,
                 const std::array<std::uint32_t, 3>& extent, std::size_t size,
                 const Neighbors& chunks) {
    const std::size_t width = extent[0] * size;
    switch (width) {
    case 16: return copy_rows_of<16>(from, row, plane, extent, chunks);
    case 32: return copy_rows_of<32>(from, row, plane, extent, chunks);
    case 64: return copy_rows_of<64>(from, row, plane, extent, chunks);
    case 128: return copy_rows_of<128>(from, row, plane, extent, chunks);
    default: break;
    }
    std::size_t at = 0;
    for (std::uint32_t z = 0; z < extent[2]; ++z)
        for (std::uint32_t y = 0; y < extent[1]; ++y, at += width)
            for (std::size_t i = 0; i < chunks.count; ++i)
                std::memcpy(chunks.to[i] + at, from + z * plane + y * row + i * width, width);
}

} // namespace

RecordChecksum record_checksum(std::span<const std::byte> record) {
    return static_cast<RecordChecksum>(XXH3_64bits(record.data(), record.size()));
}

LayerPacker::LayerPacker(const Grid& grid, ValueType type, Codec codec, unsigned threads,
                         bool wide_rows)
    : grid_(grid), type_(type), chunks_(grid) {
    const std::size_t chunk = std::size_t{kChunkEdge} * kChunkEdge * kChunkEdge * size_of(type);
    together_ = static_cast<std::uint32_t>(
        std::clamp<std::size_t>(kBytesTogether / chunk, 1, kPlacesOfPiece));
    for (unsigned i = 0; i < threads; ++i)
        packers_.push_back({ChunkPacker(codec, wide_rows), {}, {}, {}});
    pieces_.resize((chunks_.chunks_of_layer() + kPlacesOfPiece - 1) / kPlacesOfPiece);
}

/// Copies the values of chunks out of a layer, one chunk after the other.
void LayerPacker::take_values(std::span<const std::byte> stored, std::uint32_t first,
                              std::uint32_t end, Packer& to) const {
    const std::size_t size = size_of(type_);
    const std::size_t row = grid_.vertices[0] * size, plane = grid_.vertices[1] * row;
    to.begins.assign(1, 0);
    to.order.clear();
    for (std::uint32_t place = first; place < end; ++place) {
        const auto n = chunks_.size(packed_, place);
        to.begins.push_back(to.begins.back() + std::size_t{n[0]} * n[1] * n[2] * size);
        const auto [x, y] = chunks_.at(place);
        to.order.push_back({y, x, place});
    }
    to.values.resize(to.begins.back());
    std::ranges::sort(to.order);
    for (std::size_t i = 0; i < to.order.size();) {
        const auto [y, x, place] = to.order[i];
        const auto extent = chunks_.size(packed_, place);
        Neighbors neighbors;
        do {
            neighbors.to[neighbors.count++] =
                to.values.data() + to.begins[to.order[i++][2] - first];
        } while (i < to.order.size() && neighbors.count < Neighbors::kMost && to.order[i][0] == y &&
                 to.order[i][1] == x + neighbors.count &&
                 chunks_.size(packed_, to.order[i][2]) == extent);
        copy_chunks(stored.data() + y * kChunkEdge * row + x * kChunkEdge * size, row, plane,
                    extent, size, neighbors);
    }
}

/// Whether a chunk is as in the step before; remembers it as it is now.
bool LayerPacker::stays(std::uint32_t place, std::span<const std::byte> values) {
    const std::size_t at = std::size_t{packed_} * chunks_.chunks_of_layer() + place;
    const XXH128_hash_t hash = XXH3_128bits(values.data(), values.size());
    const ChunkDigest digest{hash.low64, hash.high64};
    const bool same = !first_ && digest == history_.digests[at];
    history_.digests[at] = digest;
    if (!same)
        history_.since[at] = step_;
    return same;
}

void LayerPacker::pack_chunk(const Layer& layer, std::uint32_t place,
                             std::span<const std::byte> values, ChunkPacker& packer,
                             std::vector<std::byte>& out, ChunkEntry& entry) {
    const auto [x, y] = chunks_.at(place);
    const std::size_t begin = out.size();
    out.resize(begin + sizeof(RecordChecksum));
    entry = layer.with_bricks ? ChunkEntry{} : ChunkEntry{0, 0, 255};
    if (layer.with_bricks) {
        const ChunkBricks extremes =
            bricks_of_chunk(BrickGrid(grid_), layer.brick_layers, layer.bricks, {x, y});
        const auto bytes = std::as_bytes(std::span(extremes));
        out.insert(out.end(), bytes.begin(), bytes.end());
        entry.low = *std::min_element(extremes.begin(), extremes.begin() + kBricksOfChunk);
        entry.high = *std::max_element(extremes.begin() + kBricksOfChunk, extremes.end());
    }
    const bool same = with_since_ && stays(place, values);
    entry.since =
        same ? history_.since[std::size_t{packed_} * chunks_.chunks_of_layer() + place] : step_;
    // One value for all takes no more than a look at another step.
    if (layer.carries && (!same || ChunkPacker::all_equal(type_, values)))
        packer.pack(type_, chunks_.size(packed_, place), values, out);
    const auto rest = std::span(out).subspan(begin + sizeof(RecordChecksum));
    const RecordChecksum checksum = record_checksum(rest);
    std::memcpy(out.data() + begin, &checksum, sizeof checksum);
    entry.bytes = static_cast<std::uint16_t>(out.size() - begin);
}

/// Appends the records of the places `first` to `end` - 1.
void LayerPacker::pack_piece(const Layer& layer, std::uint32_t first, std::uint32_t end,
                             Packer& packer, std::vector<std::byte>& out) {
    for (std::uint32_t next = first; first < end; first = next) {
        next = std::min(first + together_, end);
        const bool reads = layer.carries || with_since_;
        if (reads)
            take_values(layer.stored, first, next, packer);
        for (std::uint32_t place = first; place < next; ++place)
            pack_chunk(layer, place,
                       reads ? packer.value_of(place - first) : std::span<const std::byte>(),
                       packer.chunks, out, entries_[place]);
    }
}

/// Calls `f(item, first, end, worker)` for every piece of a layer, with all threads.
template <class F>
void LayerPacker::for_pieces(F&& f) {
    assert(packed_ < chunks_.layers());
    const std::uint32_t places = chunks_.chunks_of_layer();
    if (with_since_) {
        history_.digests.resize(chunks_.count());
        history_.since.resize(chunks_.count());
    }
    parallel_for(pieces_.size(), static_cast<unsigned>(packers_.size()),
                 [&](std::size_t item, unsigned worker) {
                     const auto first = static_cast<std::uint32_t>(item) * kPlacesOfPiece;
                     f(item, first, std::min(first + kPlacesOfPiece, places), worker);
                 },
                 {});
}

/// The next layer, or the next step, follows.
void LayerPacker::end_layer() {
    if (++packed_ < chunks_.layers())
        return;
    packed_ = 0;
    first_ = false;
    ++step_;
}

void LayerPacker::look(std::span<const std::byte> stored) {
    for_pieces([&](std::size_t, std::uint32_t first, std::uint32_t end, unsigned worker) {
        Packer& packer = packers_[worker];
        take_values(stored, first, end, packer);
        for (std::uint32_t place = first; place < end; ++place)
            stays(place, packer.value_of(place - first));
    });
    end_layer();
}

void LayerPacker::pack(const Layer& layer, const Append& append) {
    const std::uint32_t places = chunks_.chunks_of_layer();
    entries_.resize(places);
    for_pieces([&](std::size_t item, std::uint32_t first, std::uint32_t end, unsigned worker) {
        pieces_[item].clear();
        pack_piece(layer, first, end, packers_[worker], pieces_[item]);
    });
    const std::size_t entry_bytes = with_since_ ? sizeof(ChunkEntry) : kEntryWithoutSince;
    const std::uint64_t table_bytes = layer_table_bytes(places, with_since_);
    const std::size_t begin = tables_.size();
    tables_.resize(begin + table_bytes);
    std::byte* table = tables_.data() + begin;
    LayerHead head{0, end_};
    std::memcpy(table, &head, sizeof head);
    for (std::uint32_t place = 0; place < places; ++place) {
        std::memcpy(table + sizeof head + place * entry_bytes, &entries_[place], entry_bytes);
        stayed_ += entries_[place].since < step_ ? 1 : 0;
    }
    head.checksum = checksum_of({table + sizeof head.checksum, table_bytes - sizeof head.checksum});
    std::memcpy(table, &head, sizeof head);
    for (const std::vector<std::byte>& piece : pieces_) {
        append(piece);
        end_ += piece.size();
    }
    end_layer();
}

StepEntry LayerPacker::finish(const Append& append) {
    assert(packed_ == 0 && !tables_.empty());
    append(tables_);
    const StepEntry entry{.offset = 0, .bytes = end_ + tables_.size(), .tables = end_};
    tables_.clear();
    end_ = 0;
    return entry;
}

} // namespace isochron::index
