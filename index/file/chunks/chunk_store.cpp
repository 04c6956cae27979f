// Reads and decodes chunks.
#include "index/file/chunks/chunk_store.h"

#include "index/file/chunks/spare_memory.h"
#include "index/file/sections/step_levels.h"

#include <algorithm>
#include <utility>

namespace isochron::index {
namespace {

/// Bytes of tables that are read at a time.
constexpr std::uint64_t kTables = 1 << 20;
/// A step up to this size is decoded as a whole when it is worked on again: a search is faster
/// then.
constexpr std::uint64_t kModerateStep = 64 << 20;
/// Memory that is kept for blended chunks.
constexpr std::size_t kSpareBytes = 64 << 20;

} // namespace

ChunkStore::ChunkStore(const ByteSource& source, ByteCache& cache, ChunkArray array)
    : source_(source), cache_(cache), array_(std::move(array)), grid_(array_.info.grid),
      decoder_(source_, array_, grid_), pool_(std::make_shared<SlotPool>(chunk_bytes())),
      for_blends_(std::make_unique<BlendMemory>(std::size_t{kChunkEdge} * kChunkEdge * kChunkEdge,
                                                kSpareBytes)),
      visited_(array_.info.steps()) {
    if (!has_step_levels(array_.info.type))
        of_type_ = std::make_shared<LevelMap>(LevelMap::of_type(array_.info.type));
}

ChunkStore::~ChunkStore() = default;

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
    const std::uint64_t size = layer_table_bytes(count, array_.has_since);
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
             table_bytes()});
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
    std::vector<std::byte> bytes(entry.bytes - levels_at(entry));
    source_.read(entry.offset + levels_at(entry), bytes);
    return keep_levels(step, bytes);
}

/// Where in a step its levels begin.
std::uint64_t ChunkStore::levels_at(const StepEntry& entry) const {
    return entry.tables +
           layer_table_bytes(grid_.chunks_of_layer(), array_.has_since) * grid_.layers();
}

/// Keeps the levels of a type that has levels in each step.
LevelMapPtr ChunkStore::keep_levels(std::uint32_t step, std::span<const std::byte> bytes) const {
    auto levels = step_levels(array_.info.type, bytes);
    if (!levels)
        decoder_.damaged(step, "the levels of its bricks");
    auto kept = std::make_shared<LevelMap>(std::move(*levels));
    // For types of two bytes the map has a table, too.
    cache_.add(key(levels_kept, step), kept,
               bytes.size() + (size_of(array_.info.type) == 2 ? 1 << 16 : 0));
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

/// Which of the places have values that lie in earlier steps, by step.
std::vector<ChunkStore::PlacesOfStep>
ChunkStore::elsewhere(std::uint32_t step, const ChunkLayer& table,
                      std::span<const std::uint32_t> places) const {
    std::vector<PlacesOfStep> by_step;
    for (const std::uint32_t place : places) {
        if (!decoder_.lies_elsewhere(step, table, place))
            continue;
        const auto known = std::ranges::find(by_step, table.since[place], &PlacesOfStep::step);
        if (known != by_step.end())
            known->places.push_back(place);
        else
            by_step.push_back({table.since[place], {place}});
    }
    return by_step;
}

/// Adds what is to be read for places that are not in the cache, ascending. @return its bytes
std::uint64_t ChunkStore::add_ranges(std::uint32_t step, std::uint32_t layer,
                                     std::span<const std::uint32_t> missing,
                                     std::vector<ByteRange>& to) const {
    std::uint64_t bytes = 0;
    if (missing.empty())
        return bytes;
    const ChunkLayerPtr table = this->layer(step, layer);
    for (const RecordRun& run : runs_of(*table, missing)) {
        to.push_back({run.begin, run.end - run.begin});
        bytes += to.back().bytes;
    }
    return bytes + add_ranges_of_earlier(step, layer, *table, missing, to);
}

/// Adds the records of earlier steps that have the values of these places.
std::uint64_t ChunkStore::add_ranges_of_earlier(std::uint32_t step, std::uint32_t layer,
                                                const ChunkLayer& table,
                                                std::span<const std::uint32_t> missing,
                                                std::vector<ByteRange>& to) const {
    std::uint64_t bytes = 0;
    for (const PlacesOfStep& earlier : elsewhere(step, table, missing))
        bytes +=
            add_ranges(earlier.step, layer, this->missing(earlier.step, layer, earlier.places), to);
    return bytes;
}

std::uint64_t ChunkStore::expect(std::uint32_t step, std::uint32_t first,
                                 std::span<const std::vector<std::uint32_t>> places) const {
    std::uint64_t bytes = 0;
    std::vector<ByteRange> ranges;
    for (const std::vector<std::uint32_t>& of_layer : places) {
        const std::uint32_t layer = first++;
        if (!of_layer.empty())
            bytes += add_ranges(step, layer, missing(step, layer, of_layer), ranges);
    }
    source_.expect_each(ranges);
    return bytes;
}

/// Whether the kernel, reading ahead of here, may get beyond the step. It has windows of some MiB,
/// and begins another one wherever a read meets the mark that the last one left, whoever reads,
/// unless all of that window has been announced.
bool ChunkStore::near_end(std::uint32_t step, std::uint64_t end) const {
    constexpr std::uint64_t kMostAhead = 24 << 20;
    return end + kMostAhead > array_.steps[step].offset + array_.steps[step].bytes;
}

void ChunkStore::read_in_order(std::uint32_t step, std::uint64_t offset, std::span<std::byte> out,
                               bool& announced) const {
    if (!near_end(step, offset + out.size()))
        return source_.read_in_order(offset, out);
    if (!std::exchange(announced, true))
        source_.expect(offset, array_.steps[step].offset + array_.steps[step].tables - offset);
    source_.read(offset, out);
}

std::uint64_t ChunkStore::fetch(std::uint32_t step, std::uint32_t layer,
                                std::span<const std::uint32_t> places,
                                const std::stop_token& stop) const {
    const std::vector<std::uint32_t> missing = this->missing(step, layer, places);
    std::vector<ByteRange> ranges;
    if (!fetches_all(missing.size())) {
        const std::uint64_t bytes = add_ranges(step, layer, missing, ranges);
        source_.expect_each(ranges);
        return bytes;
    }
    const ChunkLayerPtr table = this->layer(step, layer);
    if (near_end(step, table->offsets.back()))
        source_.expect(table->offsets.front(), table->offsets.back() - table->offsets.front());
    else
        source_.fetch(table->offsets.front(), table->offsets.back() - table->offsets.front(), stop);
    const std::uint64_t earlier = add_ranges_of_earlier(step, layer, *table, missing, ranges);
    source_.expect_each(ranges);
    return table->offsets.back() - table->offsets.front() + earlier;
}

std::shared_ptr<Chunk> ChunkStore::decoded(std::uint32_t step, std::uint32_t layer,
                                           std::uint32_t place, std::span<const std::byte> record,
                                           bool with_values) const {
    if (!with_values) {
        auto chunk = std::make_shared<Chunk>();
        chunk->size = grid_.size(layer, place);
        decoder_.chunk(step, layer, place, record, chunk->bricks, {});
        return chunk;
    }
    std::byte* const slot = pool_->take();
    const std::shared_ptr<Chunk> chunk(new (slot) Chunk, [pool = pool_](Chunk* done) {
        done->~Chunk();
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
    use_earlier(layer, places, found);
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
    std::vector<std::shared_ptr<Chunk>> read(missing.size());
    read_records(*table, missing, stop, [&](std::size_t i, std::span<const std::byte> record) {
        const bool here = !decoder_.lies_elsewhere(step, *table, missing[i]);
        read[i] = decoded(step, layer, missing[i], record, here);
        added.push_back({known[where[i]], read[i], here ? chunk_bytes() : 2 * sizeof(Chunk)});
        found[where[i]] = read[i];
    });
    add_earlier(step, layer, *table, missing, read, stop);
    cache_.add_all(std::move(added));
    return found;
}

/// Chunks that stay hold the chunk of the earlier step that has the values. So the cache drops the
/// earlier ones after those that hold them, as their bytes are counted there.
void ChunkStore::use_earlier(std::uint32_t layer, std::span<const std::uint32_t> places,
                             std::span<const ChunkPtr> chunks) const {
    std::vector<ByteCache::Key> earlier;
    for (std::size_t i = 0; i < chunks.size(); ++i)
        if (chunks[i] && chunks[i]->earlier)
            earlier.push_back(key(chunk_kept, chunks[i]->since, layer, places[i]));
    if (!earlier.empty())
        cache_.touch(earlier);
}

/// Adds the values that lie in earlier steps. @param chunks of the places, in the same order
void ChunkStore::add_earlier(std::uint32_t step, std::uint32_t layer, const ChunkLayer& table,
                             std::span<const std::uint32_t> places,
                             std::span<const std::shared_ptr<Chunk>> chunks,
                             const std::stop_token& stop) const {
    for (const PlacesOfStep& earlier : elsewhere(step, table, places)) {
        const ChunkLayerPtr there = this->layer(earlier.step, layer);
        for (const std::uint32_t place : earlier.places)
            if (decoder_.lies_elsewhere(earlier.step, *there, place))
                decoder_.damaged(step, layer, place, "an earlier step lacks its values");
        const std::vector<ChunkPtr> found = this->chunks(earlier.step, layer, earlier.places, stop);
        auto at = places.begin();
        for (std::size_t i = 0; i < found.size(); ++i) {
            at = std::lower_bound(at, places.end(), earlier.places[i]);
            Chunk& chunk = *chunks[static_cast<std::size_t>(at - places.begin())];
            chunk.values = found[i]->values;
            chunk.since = earlier.step;
            chunk.earlier = found[i];
        }
    }
}

bool ChunkStore::holds_whole(std::uint32_t step) const {
    return cache_.held({{key(whole_kept, step)}})[0];
}

std::size_t ChunkStore::staying(std::uint32_t step, std::uint32_t layer) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        this->layer(step, layer)->since, [step](std::uint32_t since) { return since < step; }));
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
