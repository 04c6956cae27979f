// Reads and decodes all chunks of a layer, or of a step, straight to their places.
#include "index/file/chunks/chunk_store.h"
#include "index/file/sections/metadata.h"
#include "index/system/huge_pages.h"
#include "index/system/parallel.h"
#include "index/system/read_ahead.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace isochron::index {
namespace {

/// Starting threads takes longer than decoding a step up to this size.
constexpr std::size_t kByOneThread = 2 << 20;

/// Bytes of a small step that are read at a time where not all are read at once: their memory is used
/// again for the next ones.
constexpr std::uint64_t kOfSmallStep = 64 << 10;

struct WholeStep {
    LargeMemory values; ///< their padding is zero
    std::vector<std::uint8_t> bricks;
};

/// Large memory for a step, in which access is in any order; its padding is 0.
LargeMemory step_memory(std::size_t bytes) {
    LargeMemory memory = large_memory(bytes);
    if (bytes <= kByOneThread)
        fetch_pages({memory.get(), bytes});
    const std::size_t padding = std::min(bytes, kPartAlignment);
    std::fill_n(memory.get() + bytes - padding, padding, std::byte{0});
    return memory;
}

/// Copies a chunk's bricks to their places in the order of `build_bricks`.
void place_bricks(const ChunkBricks& of_chunk, const BrickGrid& grid,
                  const std::array<std::uint32_t, 3>& at, std::span<std::uint8_t> bricks) {
    for (std::uint32_t i = 0; i < kBricksOfChunk; ++i)
        if (const auto brick = brick_of_chunk(grid, at, i)) {
            bricks[*brick] = of_chunk[i];
            bricks[grid.count() + *brick] = of_chunk[kBricksOfChunk + i];
        }
}

} // namespace

void ChunkStore::read_records(const ChunkLayer& table, std::span<const std::uint32_t> places,
                              const std::stop_token& stop, const TakeRecord& f) const {
    thread_local std::vector<std::byte> bytes;
    const std::uint64_t together = is_small() ? kOfSmallStep : kRecordsTogether;
    const std::vector<RecordRun> runs = runs_of(table, places, together);
    std::vector<RangeRead> reads;
    for (std::size_t first = 0, next = 0; first < runs.size(); first = next) {
        stop_if_asked(stop);
        std::uint64_t size = 0; // runs are decoded while in the processor's cache
        for (; next < runs.size(); ++next) {
            const std::uint64_t with_next = size + runs[next].end - runs[next].begin;
            if (next > first && (is_small() || with_next > together))
                break;
            size = with_next;
        }
        if (const std::uint64_t room = std::max(together, size);
            bytes.capacity() < room) { // grows once
            bytes.clear();
            make_room(bytes, room);
        }
        bytes.resize(std::max<std::size_t>(bytes.size(), size));
        reads.clear();
        for (std::size_t i = first, at = 0; i < next; ++i) {
            reads.push_back(
                {runs[i].begin, std::span(bytes).subspan(at, runs[i].end - runs[i].begin)});
            at += reads.back().out.size();
        }
        source_.read_each(reads);
        for (std::size_t run = first; run < next; ++run)
            for (std::size_t i = runs[run].first; i <= runs[run].last; ++i)
                f(i, reads[run - first].out.subspan(table.offsets[places[i]] - runs[run].begin,
                                                    table.bytes(places[i])));
    }
}

/// Reads all of a small step in one request, and keeps its tables and the levels of its bricks. The
/// memory is free again before the results are made, which may lie there.
std::vector<std::byte> ChunkStore::read_at_once(std::uint32_t step) const {
    const StepEntry& entry = array_.steps[step];
    std::vector<std::byte> bytes;
    make_room(bytes, entry.bytes);
    bytes.resize(entry.bytes);
    source_.read(entry.offset, bytes);
    const std::uint32_t count = grid_.chunks_of_layer();
    const std::uint64_t size = layer_table_bytes(count, array_.has_since);
    std::vector<ByteCache::Entry> tables;
    for (std::uint32_t layer = 0; layer < grid_.layers(); ++layer)
        tables.push_back(
            {key(layer_kept, step, layer),
             decoder_.table(step, layer,
                            std::span(bytes).subspan(entry.tables + layer * size, size)),
             table_bytes()});
    cache_.add_all(std::move(tables));
    if (array_.has_bricks && !of_type_)
        keep_levels(step, std::span(bytes).subspan(levels_at(entry)));
    return bytes;
}

/// Announces all of a step: its tables, which are needed first, and its chunks.
void ChunkStore::expect_all(std::uint32_t step) const {
    const StepEntry& entry = array_.steps[step];
    source_.expect(entry.offset + entry.tables, entry.bytes - entry.tables);
    source_.expect(entry.offset, entry.tables);
}

/// @param all bytes of the step; empty: those that are needed are read
/// @param before planes of the layer in the step before; empty: they are not in memory
void ChunkStore::decode_from(std::span<const std::byte> all, std::span<const std::byte> before,
                             std::uint32_t step, std::uint32_t layer,
                             std::span<const std::uint32_t> places, std::span<std::byte> planes,
                             std::span<std::uint8_t> bricks, const std::stop_token& stop) const {
    const SeriesInfo& info = array_.info;
    const std::size_t size = size_of(info.type), row = info.grid.vertices[0] * size;
    const std::size_t plane = info.grid.vertices[1] * row;
    const BrickGrid brick_grid(info.grid);
    const ChunkLayerPtr table = this->layer(step, layer);
    std::vector<std::byte> memory(most_values());
    ChunkBricks of_chunk;
    const auto put = [&](std::uint32_t place, const std::byte* from) {
        const auto extent = grid_.size(layer, place);
        const auto [x, y] = grid_.at(place);
        for (std::uint32_t dz = 0; array_.has_values && dz < extent[2]; ++dz)
            for (std::uint32_t dy = 0; dy < extent[1]; ++dy) {
                std::memcpy(planes.data() + dz * plane + (y * kChunkEdge + dy) * row +
                                x * kChunkEdge * size,
                            from, extent[0] * size);
                from += extent[0] * size;
            }
    };
    const TakeRecord take = [&](std::size_t i, std::span<const std::byte> record) {
        const bool here = !decoder_.lies_elsewhere(step, *table, places[i]);
        const auto values =
            std::span(memory).first(here ? bytes_of(grid_.size(layer, places[i])) : 0);
        decoder_.chunk(step, layer, places[i], record, of_chunk, values);
        const auto [x, y] = grid_.at(places[i]);
        if (!bricks.empty())
            place_bricks(of_chunk, brick_grid, {x, y, layer}, bricks);
        if (here)
            put(places[i], values.data());
    };
    for (std::size_t i = 0; !all.empty() && i < places.size(); ++i)
        take(i, all.subspan(table->offsets[places[i]] - array_.steps[step].offset,
                            table->bytes(places[i])));
    if (all.empty())
        read_records(*table, places, stop, take);
    const auto put_before = [&](std::uint32_t place) {
        const auto extent = grid_.size(layer, place);
        const auto [x, y] = grid_.at(place);
        for (std::uint32_t dz = 0; dz < extent[2]; ++dz)
            for (std::uint32_t dy = 0; dy < extent[1]; ++dy) {
                const std::size_t at =
                    dz * plane + (y * kChunkEdge + dy) * row + x * kChunkEdge * size;
                std::memcpy(planes.data() + at, before.data() + at, extent[0] * size);
            }
    };
    for (const PlacesOfStep& earlier : elsewhere(step, *table, places)) {
        if (!before.empty()) {
            std::ranges::for_each(earlier.places, put_before);
            continue;
        }
        const auto found = this->chunks(earlier.step, layer, earlier.places, stop);
        for (std::size_t i = 0; i < found.size(); ++i)
            put(earlier.places[i], found[i]->values.data());
    }
}

void ChunkStore::decode(std::uint32_t step, std::uint32_t layer,
                        std::span<const std::uint32_t> places, std::span<std::byte> planes,
                        std::span<std::uint8_t> bricks, const std::stop_token& stop) const {
    decode_from({}, {}, step, layer, places, planes, bricks, stop);
}

LoadedStep ChunkStore::whole(std::uint32_t step, const std::stop_token& stop) const {
    const SeriesInfo& info = array_.info;
    const std::size_t stride = step_stride(info.step_bytes());
    auto held = cache_.find<WholeStep>(key(whole_kept, step));
    if (!held) {
        auto all = std::make_shared<WholeStep>();
        if (array_.has_values)
            all->values = step_memory(stride);
        if (array_.has_bricks)
            all->bricks.resize(BrickGrid(info.grid).bytes_per_step());
        const std::size_t layer_bytes = std::size_t{info.grid.vertices[0]} * info.grid.vertices[1] *
                                        size_of(info.type) * kChunkEdge;
        std::vector<std::uint32_t> places(grid_.chunks_of_layer());
        std::iota(places.begin(), places.end(), 0u);
        std::shared_ptr<const WholeStep> before;
        if (const ByteCache::Key at = key(whole_kept, step - 1);
            step > 0 && array_.has_values && cache_.held({{at}})[0])
            before = cache_.find<WholeStep>(at);
        std::optional<ReadAhead> ahead;
        std::vector<std::byte> at_once;
        if (is_small() && stride <= kByOneThread)
            at_once = read_at_once(step);
        else if (is_small())
            expect_all(step);
        else
            ahead.emplace(grid_.layers(), [&](std::uint32_t layer) {
                stop_if_asked(stop);
                return fetch(step, layer, places, stop);
            });
        const auto take = [&](std::size_t at, unsigned) {
            const auto layer = static_cast<std::uint32_t>(at);
            if (ahead)
                ahead->reach(layer);
            std::span<std::byte> planes;
            std::span<const std::byte> planes_before;
            if (array_.has_values)
                planes = std::span(all->values.get(), stride).subspan(layer * layer_bytes);
            if (before)
                planes_before = std::span<const std::byte>(before->values.get(), stride)
                                    .subspan(layer * layer_bytes);
            decode_from(at_once, planes_before, step, layer, places, planes, all->bricks, stop);
        };
        parallel_for(grid_.layers(), stride <= kByOneThread ? 1 : thread_count(0), take, {});
        cache_.add(key(whole_kept, step), all, stride + all->bricks.size());
        held = all;
    }
    return {.values = {.grid = info.grid,
                       .type = info.type,
                       .scaling = info.scaling,
                       .steps = info.steps(),
                       .first = held->values.get(),
                       .stride = stride,
                       .first_step = step},
            .bricks = held->bricks,
            .owner = held};
}

} // namespace isochron::index
