// The chunks of one array of an open index: read when they are needed, kept while there is room.
#pragma once

#include "index/file/byte_cache.h"
#include "index/file/chunk_grid.h"
#include "index/file/chunk_table.h"
#include "index/file/file_layout.h"
#include "index/file/index_contents.h"
#include "index/system/slot_pool.h"
#include "index/volume/level_map.h"

#include <memory>
#include <mutex>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

namespace isochron::index {

/// One chunk of a step.
struct Chunk {
    std::array<std::uint32_t, 3> size{}; ///< vertices along x, y and z
    ChunkBricks bricks{};                ///< of no meaning in an index without bricks
    std::span<const std::byte> values;   ///< [z][y][x], x fastest; empty where the file has none
};
using ChunkPtr = std::shared_ptr<const Chunk>;

/// Where the chunks of a layer lie, and between which ranks their cells are.
struct ChunkLayer {
    std::vector<std::uint64_t> offsets;  ///< in the file, by place; one more than there are chunks
    std::vector<std::uint8_t> low, high; ///< by place
};
using LevelMapPtr = std::shared_ptr<const LevelMap>;
using ChunkLayerPtr = std::shared_ptr<const ChunkLayer>;

/// Thrown by reading that was given up because it was asked to stop.
struct Stopped {};

/// What is to be known of an array before its chunks can be read.
struct ChunkArray {
    std::string called;       ///< for messages: `volume`
    std::uint32_t number = 0; ///< tells arrays of one cache apart
    SeriesInfo info;
    std::vector<StepEntry> steps;
    bool has_bricks = false, has_values = true;
};

/// Thread-safe. Every function but the first few throws Error where the file is damaged or cannot
/// be read.
class ChunkStore {
  public:
    /// @param source, cache outlive this
    ChunkStore(const ByteSource& source, ByteCache& cache, ChunkArray array);

    const SeriesInfo& info() const { return array_.info; }
    const ChunkGrid& grid() const { return grid_; }

    /// Reads the tables of the layers around with it, where they are not known yet.
    ChunkLayerPtr layer(std::uint32_t step, std::uint32_t layer) const;
    /// What the bricks of a step are ranks among; of an index that has bricks.
    LevelMapPtr levels(std::uint32_t step) const;
    /// @param places ascending @return in the same order
    /// @throws Stopped as well
    std::vector<ChunkPtr> chunks(std::uint32_t step, std::uint32_t layer,
                                 std::span<const std::uint32_t> places,
                                 const std::stop_token& stop = {}) const;
    /// Says that chunks will be asked for soon, so that the disk works on many requests at once.
    /// @param places ascending @return bytes that are to be read for them
    std::uint64_t expect(std::uint32_t step, std::uint32_t layer,
                         std::span<const std::uint32_t> places) const;

    /// The values and bricks of one step as a whole, for work that needs all of it.
    /// @throws Stopped as well
    LoadedStep whole(std::uint32_t step, const std::stop_token& stop = {}) const;
    /// Whether working on the whole step is better than on the chunks that are needed: where it is
    /// small, is kept already, or is of moderate size and has been worked on before.
    bool better_whole(std::uint32_t step) const;
    /// Says that a step has been worked on.
    void worked_on(std::uint32_t step) const;

  private:
    ByteCache::Key key(unsigned kind, std::uint32_t step, std::uint32_t layer = 0,
                       std::uint32_t place = 0) const;
    std::size_t chunk_bytes() const;
    ChunkPtr decoded(std::uint32_t step, std::uint32_t layer, std::uint32_t place,
                     std::span<const std::byte> record) const;
    template <class F>
    void read_records(const ChunkLayer& table, std::span<const std::uint32_t> places,
                      const std::stop_token& stop, F&& f) const;
    std::vector<ByteCache::Key> keys(std::uint32_t step, std::uint32_t layer,
                                     std::span<const std::uint32_t> places) const;
    ChunkLayerPtr table_from(std::uint32_t step, std::uint32_t layer,
                             std::span<const std::byte> bytes) const;
    [[noreturn]] void damaged(std::uint32_t step, const std::string& what) const;

    const ByteSource& source_;
    ByteCache& cache_;
    ChunkArray array_;
    ChunkGrid grid_;
    LevelMapPtr of_type_;            ///< of an 8-bit type
    std::shared_ptr<SlotPool> pool_; ///< of chunks with their values
    mutable std::mutex visits_mutex_;
    mutable std::vector<bool> visited_; ///< steps that have been worked on
};

} // namespace isochron::index
