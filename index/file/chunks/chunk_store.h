// The chunks of one array of an open index: read when needed, kept in the cache.
#pragma once

#include "index/file/chunks/byte_cache.h"
#include "index/file/chunks/chunk_grid.h"
#include "index/file/chunks/chunk_records.h"
#include "index/file/sections/index_contents.h"
#include "index/system/slot_pool.h"
#include "index/volume/level_map.h"

#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <stop_token>
#include <vector>

namespace isochron::index {

struct alignas(32) Chunk;
using ChunkPtr = std::shared_ptr<const Chunk>;

/// One chunk of a step.
struct alignas(32) Chunk {
    std::array<std::uint32_t, 3> size{}; ///< vertices along x, y and z
    ChunkBricks bricks{};                ///< undefined in an index without bricks
    std::span<const std::byte> values;   ///< [z][y][x], x fastest; empty if the file has none
    ChunkPtr earlier;        ///< the chunk of an earlier step that has the values, if any
    std::uint32_t since = 0; ///< number of that step
};

using LevelMapPtr = std::shared_ptr<const LevelMap>;

/// Thrown by a read that was asked to stop.
struct Stopped {};
/// @throws Stopped if it is requested
inline void stop_if_asked(const std::stop_token& stop) {
    if (stop.stop_requested())
        throw Stopped();
}

struct BlendMemory;

/// Thread-safe. Functions that read the file throw Error if it is damaged or cannot be read.
class ChunkStore {
  public:
    /// @param source, cache outlive this
    ChunkStore(const ByteSource& source, ByteCache& cache, ChunkArray array);
    ~ChunkStore();

    const SeriesInfo& info() const { return array_.info; }
    const ChunkGrid& grid() const { return grid_; }
    /// Whether the file has the values of its chunks.
    bool carries_values() const { return array_.has_values; }
    bool has_bricks() const { return array_.has_bricks; }
    const ChunkDecoder& decoder() const { return decoder_; }
    const ByteSource& source() const { return source_; }
    /// What blends of its steps share.
    BlendMemory& for_blends() const { return *for_blends_; }

    /// The table of a layer; if it is not in the cache, tables of neighboring layers are read too.
    ChunkLayerPtr layer(std::uint32_t step, std::uint32_t layer) const;
    /// The levels whose ranks a step's bricks hold. The index must have bricks.
    LevelMapPtr levels(std::uint32_t step) const;
    /// @param places ascending @return the chunks in the same order
    /// @throws Stopped as well
    std::vector<ChunkPtr> chunks(std::uint32_t step, std::uint32_t layer,
                                 std::span<const std::uint32_t> places,
                                 const std::stop_token& stop = {}) const;
    /// Announces that chunks will be needed soon, so that the disk works on many requests at once.
    /// @param first a layer, which may be 0 - 1 where it has no places
    /// @param places of this layer and of those behind it, ascending in each
    /// @return bytes that must be read for them
    std::uint64_t expect(std::uint32_t step, std::uint32_t first,
                         std::span<const std::vector<std::uint32_t>> places) const;

    /// Fetches; if most of a layer's bytes must be read, all of it is read in one go, and this
    /// waits until it has come from the disk.
    std::uint64_t fetch(std::uint32_t step, std::uint32_t layer,
                        std::span<const std::uint32_t> places, const std::stop_token& stop) const;
    /// Reads bytes of a step that are read in order, the kernel reading ahead as it sees fit. Near the
    /// end of the step it would read what follows the step, too: there all bytes that are left are
    /// announced instead, once.
    /// @param announced whether that has been done
    void read_in_order(std::uint32_t step, std::uint64_t offset, std::span<std::byte> out,
                       bool& announced) const;
    /// Whether `fetch` of so many chunks of a layer, none of them in the cache, reads the whole
    /// layer: a sixth of the chunks are so spread that, with their neighbors, most are needed.
    bool fetches_all(std::size_t places) const { return 6 * places >= grid_.chunks_of_layer(); }

    /// The values and bricks of one whole step, for work that needs all of it.
    /// @throws Stopped as well
    LoadedStep whole(std::uint32_t step, const std::stop_token& stop = {}) const;
    /// Decodes some chunks of a layer to their places; keeps nothing.
    /// @param planes of the layer, [z][y][x]; unused if the file has no values
    /// @param bricks of the whole step, as from `build_bricks`; empty: they are not wanted
    void decode(std::uint32_t step, std::uint32_t layer, std::span<const std::uint32_t> places,
                std::span<std::byte> planes, std::span<std::uint8_t> bricks,
                const std::stop_token& stop = {}) const;
    /// Whether what `whole` gives is in the cache.
    bool holds_whole(std::uint32_t step) const;

    /// Bytes of the values of a chunk of so many vertices.
    std::size_t bytes_of(const std::array<std::uint32_t, 3>& size) const;
    /// Bytes of the values of a chunk that is not clipped.
    std::size_t most_values() const { return bytes_of({kChunkEdge, kChunkEdge, kChunkEdge}); }

    /// Number of chunks of a layer that are as in the step before.
    std::size_t staying(std::uint32_t step, std::uint32_t layer) const;

    /// Whether work on the whole step is faster than on the needed chunks alone: if the step is
    /// small, or of moderate size and `worked_on` before, and fits into a quarter of the cache.
    bool better_whole(std::uint32_t step) const;
    /// Whether a step is small enough to be read as a whole, in one request or announced at once.
    bool is_small() const { return array_.info.step_bytes() <= kSmallStep; }
    /// Notes that a step has been worked on.
    void worked_on(std::uint32_t step) const;
    bool was_worked_on(std::uint32_t step) const;

  private:
    enum Kind : unsigned { chunk_kept, layer_kept, whole_kept, levels_kept, kinds };
    /// A step up to this size is always read and decoded as a whole, which takes less time than
    /// choosing chunks: 256 x 128 x 64 of f32, and a vertex more along each axis.
    static constexpr std::uint64_t kSmallStep = 9 << 20;

    ByteCache::Key key(unsigned kind, std::uint32_t step, std::uint32_t layer = 0,
                       std::uint32_t place = 0) const;
    std::size_t chunk_bytes() const;
    /// Some places of a layer at a step.
    struct PlacesOfStep {
        std::uint32_t step;
        std::vector<std::uint32_t> places;
    };
    std::vector<PlacesOfStep> elsewhere(std::uint32_t step, const ChunkLayer& table,
                                        std::span<const std::uint32_t> places) const;
    void use_earlier(std::uint32_t layer, std::span<const std::uint32_t> places,
                     std::span<const ChunkPtr> chunks) const;
    void add_earlier(std::uint32_t step, std::uint32_t layer, const ChunkLayer& table,
                     std::span<const std::uint32_t> places,
                     std::span<const std::shared_ptr<Chunk>> chunks,
                     const std::stop_token& stop) const;
    std::shared_ptr<Chunk> decoded(std::uint32_t step, std::uint32_t layer, std::uint32_t place,
                                   std::span<const std::byte> record, bool with_values) const;
    /// Bytes of a table in the cache.
    std::uint64_t table_bytes() const {
        return grid_.chunks_of_layer() * (sizeof(std::uint64_t) + sizeof(std::uint32_t) + 2);
    }
    std::uint64_t levels_at(const StepEntry& entry) const;
    LevelMapPtr keep_levels(std::uint32_t step, std::span<const std::byte> bytes) const;
    bool near_end(std::uint32_t step, std::uint64_t end) const;
    void expect_all(std::uint32_t step) const;
    std::vector<std::byte> read_at_once(std::uint32_t step) const;
    void decode_from(std::span<const std::byte> all, std::span<const std::byte> before,
                     std::uint32_t step, std::uint32_t layer, std::span<const std::uint32_t> places,
                     std::span<std::byte> planes, std::span<std::uint8_t> bricks,
                     const std::stop_token& stop) const;
    /// Calls `f(i, record)` for every place, `i` counting from 0.
    using TakeRecord = std::function<void(std::size_t i, std::span<const std::byte> record)>;
    void read_records(const ChunkLayer& table, std::span<const std::uint32_t> places,
                      const std::stop_token& stop, const TakeRecord& f) const;
    std::vector<std::uint32_t> missing(std::uint32_t step, std::uint32_t layer,
                                       std::span<const std::uint32_t> places) const;
    std::uint64_t add_ranges(std::uint32_t step, std::uint32_t layer,
                             std::span<const std::uint32_t> missing,
                             std::vector<ByteRange>& to) const;
    std::uint64_t add_ranges_of_earlier(std::uint32_t step, std::uint32_t layer,
                                        const ChunkLayer& table,
                                        std::span<const std::uint32_t> missing,
                                        std::vector<ByteRange>& to) const;
    std::vector<ByteCache::Key> keys(std::uint32_t step, std::uint32_t layer,
                                     std::span<const std::uint32_t> places) const;
    const ByteSource& source_;
    ByteCache& cache_;
    ChunkArray array_;
    ChunkGrid grid_;
    ChunkDecoder decoder_;
    LevelMapPtr of_type_;            ///< levels of all steps, for an 8-bit type
    std::shared_ptr<SlotPool> pool_; ///< memory of chunks with their values
    std::unique_ptr<BlendMemory> for_blends_;
    mutable std::mutex visits_mutex_;
    mutable std::vector<bool> visited_; ///< steps that have been worked on
};

} // namespace isochron::index
