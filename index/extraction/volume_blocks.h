// Volume blocks: the parts of a step's volume that its active cells need, packed for a GPU.
#pragma once

#include "index/extraction/block_values.h"
#include "index/file/step_view.h"
#include "index/search/staying_cells.h"
#include "index/surface/cell_set.h"
#include "index/volume/step_values.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// Vertices along each side of a volume block. In this file, "block" always means a volume block;
/// the bricks of scan/bricks.h are blocks of 8 x 4 x 4 cells.
constexpr std::uint32_t kBlockEdge = 8;
constexpr std::uint32_t kBlockVertices = kBlockEdge * kBlockEdge * kBlockEdge;

using BlockId = std::uint32_t; ///< x fastest, then y, then z

/// The blocks that tile the vertices of a grid; the last ones of an axis may reach beyond the grid.
struct BlockTiling {
    explicit BlockTiling(const Grid& grid);
    std::size_t count() const { return std::size_t{blocks[0]} * blocks[1] * blocks[2]; }
    std::array<std::uint32_t, 3> blocks;
};

/// A hash of 128 bits of a block's bytes: equal digests mean equal bytes.
struct BlockDigest {
    std::uint64_t low = 0, high = 0;
    bool operator==(const BlockDigest&) const = default;
};

/// Memory of some blocks, which several extractions may share.
struct BlockMemory {
    std::shared_ptr<const std::byte> first;
    std::size_t bytes = 0;
};

/// Some blocks of one step.
struct VolumeBlocks {
    ValueType held = ValueType::f32;  ///< type of the values in `bytes`
    float factor = 1;                 ///< see BlockValues
    float range = 1;                  ///< width of the data set's range, in block units
    std::vector<BlockId> ids;         ///< ascending
    std::vector<BlockDigest> digests; ///< in the same order: a block with the same id and digest
                                      ///< need not be uploaded again
    std::vector<const std::byte*> places; ///< in the same order: where the bytes of each block are
    std::vector<BlockMemory> memory;      ///< the memory in which the bytes are

    std::size_t block_bytes() const { return kBlockVertices * size_of(held); }
    std::uint64_t bytes() const { return std::uint64_t{ids.size()} * block_bytes(); }
    /// [z][y][x], x fastest; 0 beyond the grid.
    std::span<const std::byte> block(std::size_t i) const { return {places[i], block_bytes()}; }
    /// The bytes of all blocks, one after the other.
    std::vector<std::byte> joined() const;
};

/// Blocks of an earlier extraction, and which chunks stay: the blocks in these are taken over.
struct KnownBlocks {
    const VolumeBlocks* blocks = nullptr;
    const StayingCells* staying = nullptr;
};

/// Collects the blocks that hold the vertices of cells and the neighbors of these along each axis,
/// which central differences need.
class BlockGatherer {
  public:
    BlockGatherer(const Grid& grid, const BlockValues& values);

    /// What `gather` gives if no block is marked.
    VolumeBlocks none() const;
    /// Marks the blocks that a set's cells need. @param set with points, if the grid has wide ids
    void need(const CellSet& set);
    /// Copies the blocks that have been marked since the last call, then clears the marks. From
    /// chunks it does so with all cores.
    /// @param known blocks that are taken over; held in the same way
    /// @return false when it was stopped and the blocks are incomplete
    /// @throws Error as ChunkStore does
    bool gather(const StepView& step, const BlockLevels& levels, VolumeBlocks& blocks,
                const std::stop_token& stop = {}, const KnownBlocks& known = {});
    /// Whether a step has the same blocks for all isovalues.
    bool without_levels() const { return values_.stored() == values_.held(); }
    /// Gathers the blocks from values in memory.
    bool gather(const StepValues& step, Instant at, const BlockLevels& levels, VolumeBlocks& blocks,
                const std::stop_token& stop = {});

  private:
    struct Box;
    template <class PlaceOf>
    void mark(std::size_t cells, PlaceOf&& place_of);
    void mark_row(std::uint32_t y, std::uint32_t z);
    std::array<std::uint32_t, 3> at(BlockId block) const;
    void take_marked(VolumeBlocks& blocks);
    /// Memory for the blocks that are copied, one after the other.
    struct Room {
        std::byte* first = nullptr;
        std::vector<std::uint32_t> others; ///< places of the copied blocks among all blocks
    };
    Room take_known(const KnownBlocks& known, const ChunkGrid* chunks, VolumeBlocks& blocks) const;
    bool gather_whole(const StepValues& step, Instant at_step, const BlockLevels& levels,
                      VolumeBlocks& blocks, const std::stop_token& stop, const KnownBlocks& known,
                      const ChunkGrid* chunks);
    bool gather_chunks(const StepView& step, const BlockLevels& levels, VolumeBlocks& blocks,
                       const std::stop_token& stop, const KnownBlocks& known);
    void copy(const Box& from, const BlockLevels& levels, std::byte* out,
              BlockDigest& digest) const;

    Grid grid_;
    BlockTiling tiling_;
    BlockValues values_;
    std::size_t row_words_;             ///< words of 64 bits in a row of blocks along x
    std::vector<std::uint64_t> needed_; ///< rows of blocks, a bit for each block
    /// Bits of the blocks along x that a row of cells needs.
    std::vector<std::uint64_t> row_inner_, row_outer_;
};

} // namespace isochron::index
