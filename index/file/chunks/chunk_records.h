// The records of chunks in the file: where they lie, and what they hold.
#pragma once

#include "index/file/chunks/chunk_grid.h"
#include "index/file/chunks/chunk_table.h"
#include "index/file/sections/file_layout.h"
#include "index/system/byte_source.h"
#include "index/volume/volume_series.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace isochron::index {

/// The byte offsets of a layer's chunks, and the range of ranks in each.
struct ChunkLayer {
    std::vector<std::uint64_t> offsets;  ///< in the file, by place, then the end of the last chunk
    std::vector<std::uint8_t> low, high; ///< by place
    /// By place: the first step from which on the values have stayed the same; the step itself if
    /// they changed, or if that is not known.
    std::vector<std::uint32_t> since;

    std::uint64_t bytes(std::uint32_t place) const { return offsets[place + 1] - offsets[place]; }
};
using ChunkLayerPtr = std::shared_ptr<const ChunkLayer>;

/// What must be known of an array before its chunks can be read.
struct ChunkArray {
    std::string called;       ///< its name in messages: `volume`
    std::uint32_t number = 0; ///< different for each array that shares a cache
    SeriesInfo info;
    std::vector<StepEntry> steps;
    bool has_bricks = false, has_values = true;
    bool has_since = true; ///< its tables say since when chunks have stayed
};

/// Records that are read together.
struct RecordRun {
    std::size_t first, last; ///< first and last of the places
    std::uint64_t begin, end;
};

/// Most bytes that are read at a time: they are decoded while in the processor's cache.
constexpr std::uint64_t kRecordsTogether = 256 << 10;

/// Puts places together whose records are near each other: reading what lies between them takes
/// less time than another request. @param places ascending @param most bytes of a run, but for a
/// record with more
std::vector<RecordRun> runs_of(const ChunkLayer& table, std::span<const std::uint32_t> places,
                               std::uint64_t most = kRecordsTogether);

/// Makes sense of the bytes of one array. Throws Error, naming file, array, step and part, if they
/// are damaged.
class ChunkDecoder {
  public:
    /// @param source names the file @param source, array, grid outlive this
    ChunkDecoder(const ByteSource& source, const ChunkArray& array, const ChunkGrid& grid)
        : source_(source), array_(array), grid_(grid) {}

    /// @param bytes of a layer's table
    ChunkLayerPtr table(std::uint32_t step, std::uint32_t layer,
                        std::span<const std::byte> bytes) const;
    /// @param bricks set if the array has some
    /// @param values [z][y][x] of the chunk, x fastest, as many as it has; empty: they are not wanted
    void chunk(std::uint32_t step, std::uint32_t layer, std::uint32_t place,
               std::span<const std::byte> record, ChunkBricks& bricks,
               std::span<std::byte> values) const;
    [[noreturn]] void damaged(std::uint32_t step, const std::string& what) const;
    /// Says that a chunk is damaged.
    [[noreturn]] void damaged(std::uint32_t step, std::uint32_t layer, std::uint32_t place,
                              const std::string& what) const;
    /// Whether the values of a chunk are in the record of the step since which it has stayed.
    bool lies_elsewhere(std::uint32_t step, const ChunkLayer& table, std::uint32_t place) const {
        return array_.has_values && table.since[place] < step && table.bytes(place) == head_bytes();
    }

  private:
    /// Bytes of a record before its values.
    std::size_t head_bytes() const {
        return sizeof(RecordChecksum) + (array_.has_bricks ? sizeof(ChunkBricks) : 0);
    }

    const ByteSource& source_;
    const ChunkArray& array_;
    const ChunkGrid& grid_;
};

} // namespace isochron::index
