// Reads and decodes chunks.
#include "index/file/chunks/chunk_store.h"

#include "index/file/sections/metadata.h"
#include "index/file/sections/step_levels.h"
#include "index/system/huge_pages.h"
#include "index/system/parallel.h"
#include "index/system/read_ahead.h"

#include <algorithm>
#include <cstring>
#include <optional>

namespace isochron::index {
namespace {

enum Kind : unsigned { chunk_kept, layer_kept, whole_kept, levels_kept, kinds };

/// Bytes of tables that are read at a time.
constexpr std::uint64_t kTables = 1 << 20;
/// A step up to this size is always decoded as a whole, which takes less time than choosing chunks.
constexpr std::uint64_t kSmallStep = 4 << 20;
/// A step up to this size is decoded as a whole when it is worked on again: a search is faster
/// then.
constexpr std::uint64_t kModerateStep = 64 << 20;

struct WholeStep {
    LargeMemory values; ///< their padding is zero
    std::vector<std::uint8_t> bricks;
};

/// Large memory for a step, in which access is in any order; its padding is 0.
LargeMemory step_memory(std::size_t bytes) {
    LargeMemory memory = large_memory(bytes);
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

ChunkStore::ChunkStore(const ByteSource& source, ByteCache& cache, ChunkArray array)
    : source_(source), cache_(cache), array_(std::move(array)), grid_(array_.info.grid),
      decoder_(source_, array_, grid_), pool_(std::make_shared<SlotPool>(chunk_bytes())),
      visited_(array_.info.steps()) {
    if (!has_step_levels(array_.info.type))
        of_type_ = std::make_shared<LevelMap>(LevelMap::of_type(array_.info.type));
}

std::size_t ChunkStore::bytes_of(const std::array<std::uint32_t, 3>& size) const {
    return array_.has_values ? std::size_t{size[0]} * size[1] * size[2] * size_of(array_.info.type)
                             : 0;
}

/// Bytes of a Chunk and its values, which follow it in memory.
std::size_t ChunkStore::chunk_bytes() const {
    return sizeof(Chunk) + most_values();
}

ByteCache::Key ChunkStore::key(unsigned kind, std::uint32_t step, std::uint32_t layer,
                               std::uint32_t place) const {
    return {std::uint64_t{array_.number * kinds + kind} << 32 | step,
            std::uint64_t{layer} << 32 | place};
}

std::vector<ByteCache::Key> ChunkStore::keys(std::uint32_t step, std::uint32_t layer,
                                             std::span<const std::uint32_t> places) const {
    std::vector<ByteCache::Key> keys(places.size());
    std::ranges::transform(places, keys.begin(), [&](std::uint32_t place) {
        return key(chunk_kept, step, layer, place);
    });
    return keys;
}

ChunkLayerPtr ChunkStore::layer(std::uint32_t step, std::uint32_t layer) const {
    if (auto known = cache_.find<ChunkLayer>(key(layer_kept, step, layer)))
        return known;
    const std::uint32_t count = grid_.chunks_of_layer();
    const std::uint64_t size = layer_table_bytes(count);
    const auto together = static_cast<std::uint32_t>(std::max<std::uint64_t>(1, kTables / size));
    const std::uint32_t first = layer / together * together;
    const std::uint32_t end = std::min(first + together, grid_.layers());
    std::vector<std::byte> bytes((end - first) * size);
    const StepEntry& entry = array_.steps[step];
    source_.read(entry.offset + entry.tables + first * size, bytes);
    std::vector<ByteCache::Entry> tables;
    for (std::uint32_t i = first; i < end; ++i)
        tables.push_back(
            {key(layer_kept, step, i),
             decoder_.table(step, i, std::span(bytes).subspan((i - first) * size, size)),
             count * (sizeof(std::uint64_t) + 2)});
    auto asked = std::static_pointer_cast<const ChunkLayer>(tables[layer - first].value);
    cache_.add_all(std::move(tables));
    return asked;
}

LevelMapPtr ChunkStore::levels(std::uint32_t step) const {
    if (of_type_)
        return of_type_;
    const ByteCache::Key at = key(levels_kept, step);
    if (auto known = cache_.find<LevelMap>(at))
        return known;
    const StepEntry& entry = array_.steps[step];
    const std::uint64_t begin =
        entry.tables + layer_table_bytes(grid_.chunks_of_layer()) * grid_.layers();
    std::vector<std::byte> bytes(entry.bytes - begin);
    source_.read(entry.offset + begin, bytes);
    const auto levels = step_levels(array_.info.type, bytes);
    if (!levels)
        decoder_.damaged(step, "the levels of its bricks");
    auto kept = std::make_shared<LevelMap>(*levels);
    // For types of two bytes the map has a table, too.
    cache_.add(at, kept, bytes.size() + (size_of(array_.info.type) == 2 ? 1 << 16 : 0));
    return kept;
}

std::vector<std::uint32_t> ChunkStore::missing(std::uint32_t step, std::uint32_t layer,
                                               std::span<const std::uint32_t> places) const {
    const std::vector<bool> held = cache_.held(keys(step, layer, places));
    std::vector<std::uint32_t> missing;
    for (std::size_t i = 0; i < places.size(); ++i)
        if (!held[i])
            missing.push_back(places[i]);
    return missing;
}

/// @param missing places that are not in the cache, ascending
std::uint64_t ChunkStore::announce(std::uint32_t step, std::uint32_t layer,
                                   std::span<const std::uint32_t> missing) const {
    std::uint64_t bytes = 0;
    if (missing.empty())
        return bytes;
    for (const RecordRun& run : runs_of(*this->layer(step, layer), missing)) {
        source_.expect(run.begin, run.end - run.begin);
        bytes += run.end - run.begin;
    }
    return bytes;
}

std::uint64_t ChunkStore::expect(std::uint32_t step, std::uint32_t layer,
                                 std::span<const std::uint32_t> places) const {
    return announce(step, layer, missing(step, layer, places));
}

std::uint64_t ChunkStore::fetch(std::uint32_t step, std::uint32_t layer,
                                std::span<const std::uint32_t> places,
                                const std::stop_token& stop) const {
    const std::vector<std::uint32_t> missing = this->missing(step, layer, places);
    if (!fetches_all(missing.size()))
        return announce(step, layer, missing);
    const ChunkLayerPtr table = this->layer(step, layer);
    source_.fetch(table->offsets.front(), table->offsets.back() - table->offsets.front(), stop);
    return table->offsets.back() - table->offsets.front();
}

/// Calls `f(i, record)` for every place, `i` counting from 0.
template <class F>
void ChunkStore::read_records(const ChunkLayer& table, std::span<const std::uint32_t> places,
                              const std::stop_token& stop, F&& f) const {
    thread_local std::vector<std::byte> bytes;
    for (const RecordRun& run : runs_of(table, places)) {
        stop_if_asked(stop);
        bytes.resize(std::max<std::size_t>(bytes.size(), run.end - run.begin));
        source_.read(run.begin, std::span(bytes).first(run.end - run.begin));
        for (std::size_t i = run.first; i <= run.last; ++i) {
            const std::uint64_t begin = table.offsets[places[i]];
            f(i, std::span<const std::byte>(bytes).subspan(begin - run.begin,
                                                           table.offsets[places[i] + 1] - begin));
        }
    }
}

ChunkPtr ChunkStore::decoded(std::uint32_t step, std::uint32_t layer, std::uint32_t place,
                             std::span<const std::byte> record) const {
    std::byte* const slot = pool_->take();
    const std::shared_ptr<Chunk> chunk(new (slot) Chunk, [pool = pool_](Chunk* done) {
        pool->give_back(reinterpret_cast<std::byte*>(done));
    });
    chunk->size = grid_.size(layer, place);
    const std::span values(slot + sizeof(Chunk), bytes_of(chunk->size));
    decoder_.chunk(step, layer, place, record, chunk->bricks, values);
    chunk->values = values;
    return chunk;
}

std::vector<ChunkPtr> ChunkStore::chunks(std::uint32_t step, std::uint32_t layer,
                                         std::span<const std::uint32_t> places,
                                         const std::stop_token& stop) const {
    const std::vector<ByteCache::Key> known = keys(step, layer, places);
    std::vector<ChunkPtr> found = cache_.find_all<Chunk>(known);
    std::vector<std::uint32_t> missing;
    std::vector<std::size_t> where;
    for (std::size_t i = 0; i < places.size(); ++i)
        if (!found[i]) {
            missing.push_back(places[i]);
            where.push_back(i);
        }
    if (missing.empty())
        return found;
    const ChunkLayerPtr table = this->layer(step, layer);
    std::vector<ByteCache::Entry> added;
    added.reserve(missing.size());
    read_records(*table, missing, stop, [&](std::size_t i, std::span<const std::byte> record) {
        const ChunkPtr chunk = decoded(step, layer, missing[i], record);
        added.push_back({known[where[i]], chunk, chunk_bytes()});
        found[where[i]] = chunk;
    });
    cache_.add_all(std::move(added));
    return found;
}

LoadedStep ChunkStore::whole(std::uint32_t step, const std::stop_token& stop) const {
    const SeriesInfo& info = array_.info;
    const std::size_t stride = step_stride(info.step_bytes());
    auto held = cache_.find<WholeStep>(key(whole_kept, step));
    if (!held) {
        const BrickGrid bricks(info.grid);
        auto all = std::make_shared<WholeStep>();
        if (array_.has_values)
            all->values = step_memory(stride);
        if (array_.has_bricks)
            all->bricks.resize(bricks.bytes_per_step());
        const std::size_t size = size_of(info.type), row = info.grid.vertices[0] * size;
        const std::size_t plane = info.grid.vertices[1] * row;
        std::byte* const out = all->values.get();
        std::vector<std::uint32_t> places(grid_.chunks_of_layer());
        for (std::uint32_t place = 0; place < places.size(); ++place)
            places[place] = place;
        // Starting threads takes longer than reading a small step.
        const bool small = stride <= kSmallStep;
        std::optional<ReadAhead> ahead;
        if (small)
            source_.expect(array_.steps[step].offset, array_.steps[step].bytes);
        else
            ahead.emplace(grid_.layers(), [&](std::uint32_t layer) {
                stop_if_asked(stop);
                return fetch(step, layer, places, stop);
            });
        const auto take = [&](std::size_t at, unsigned) {
            const auto layer = static_cast<std::uint32_t>(at);
            if (ahead)
                ahead->reach(layer);
            const ChunkLayerPtr table = this->layer(step, layer);
            std::vector<std::byte> values(most_values());
            ChunkBricks of_chunk;
            read_records(
                *table, places, stop, [&](std::size_t i, std::span<const std::byte> record) {
                    const auto extent = grid_.size(layer, places[i]);
                    decoder_.chunk(step, layer, places[i], record, of_chunk,
                                   std::span(values).first(bytes_of(extent)));
                    const auto [x, y] = grid_.at(places[i]);
                    if (array_.has_bricks)
                        place_bricks(of_chunk, bricks, {x, y, layer}, all->bricks);
                    const std::byte* from = values.data();
                    for (std::uint32_t dz = 0; array_.has_values && dz < extent[2]; ++dz)
                        for (std::uint32_t dy = 0; dy < extent[1]; ++dy) {
                            std::memcpy(out + (layer * kChunkEdge + dz) * plane +
                                            (y * kChunkEdge + dy) * row + x * kChunkEdge * size,
                                        from, extent[0] * size);
                            from += extent[0] * size;
                        }
                });
        };
        parallel_for(grid_.layers(), small ? 1 : thread_count(0), take, {});
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

std::uint64_t ChunkStore::missing_bytes(std::uint32_t step, std::uint32_t layer,
                                        std::span<const std::uint32_t> places) const {
    const ChunkLayerPtr table = this->layer(step, layer);
    std::uint64_t bytes = 0;
    for (const std::uint32_t place : missing(step, layer, places))
        bytes += table->offsets[place + 1] - table->offsets[place];
    return bytes;
}

std::uint64_t ChunkStore::missing_bytes(std::uint32_t step) const {
    return cache_.held({{key(whole_kept, step)}})[0] ? 0 : array_.steps[step].bytes;
}

bool ChunkStore::better_whole(std::uint32_t step) const {
    const std::uint64_t bytes = array_.info.step_bytes();
    if (bytes > cache_.use().budget / 4)
        return false;
    return bytes <= (was_worked_on(step) ? kModerateStep : kSmallStep);
}

bool ChunkStore::was_worked_on(std::uint32_t step) const {
    const std::scoped_lock lock(visits_mutex_);
    return visited_[step];
}

void ChunkStore::worked_on(std::uint32_t step) const {
    const std::scoped_lock lock(visits_mutex_);
    visited_[step] = true;
}

} // namespace isochron::index
