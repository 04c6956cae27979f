// A slab: one layer of chunks of a step and the planes around it, as dense arrays that are filled
// only where they are needed.
#pragma once

#include "index/file/step_view.h"
#include "index/search/layer_candidates.h"
#include "index/system/huge_pages.h"
#include "index/volume/level_map.h"
#include "index/volume/step_values.h"

#include <array>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

namespace isochron::index {

class StepSlab;

/// Some planes of cells of a step in memory: a layer of chunks, or some or all of a step that is
/// worked on as a whole.
struct StepPart {
    StepValues cells;              ///< its cells and their vertices
    CellId first_cell = 0;         ///< id in the step of the cell with id 0 in `cells`
    StepValues around;             ///< with a plane more below and above, if the grid has them
    CellId first_around = 0;       ///< id in the step of the cell with id 0 in `around`
    std::uint32_t first_plane = 0; ///< z in the step of plane 0 of `around`
    std::span<const std::uint8_t> bricks = {}; ///< bricks of `cells`; empty: unknown
    bool sparse = false;      ///< values have a meaning in bricks that may hold active cells alone
    StepSlab* slab = nullptr; ///< the slab that holds it, and has to fill what lies around cells

    /// The cells between two planes of a part without a slab.
    StepPart planes(std::uint32_t first, std::uint32_t end) const;
};

/// Holds the cells whose lowest vertex lies in one layer of chunks, and the vertices that they and
/// their normals need. Values that were not filled have no meaning; filled ones stay until the next
/// `begin`. Keeps its memory: one for each thread. Functions that fill throw as ChunkStore does.
class StepSlab {
  public:
    /// Number of layers that hold cells.
    static std::uint32_t layers(const Grid& grid) {
        return (grid.cells()[2] + kChunkEdge - 1) / kChunkEdge;
    }
    /// Memory [bytes] of a slab of a step with this grid and type.
    static std::uint64_t bytes(const Grid& grid, ValueType type);

    /// Moves to a layer of a step. @param step outlives the use of this layer
    /// @param stop when it is set, functions that fill throw Stopped
    void begin(const StepView& step, std::uint32_t layer, std::stop_token stop = {});

    /// Fills the vertices of cells, and, for normals, their neighbors along each axis.
    /// @param cells of this layer, as ids of `around()`, ascending
    void fill_around(std::span<const CellId> cells, bool normals);
    void fill_all();

    /// Moves to a layer; the caller will `put` all its chunks, and nothing more is read.
    void begin_whole(const StepView& step, std::uint32_t layer, std::stop_token stop);
    /// Copies a chunk of this layer to its place. Several threads may do so at once.
    /// @param candidates its bricks that may hold active cells
    void put(const Chunk& chunk, std::uint32_t place, BricksOfChunk candidates);
    /// The bricks of `cells()`, as from `build_bricks`; only the candidates that have been put are
    /// set.
    std::span<const std::uint8_t> bricks() const { return bricks_; }
    /// Copies the planes that this slab needs of the layer next to it.
    void fill_from(const StepSlab& next);

    /// The layer's cells and their vertices; ids are counted from `first_cell()`.
    StepValues cells() const;
    CellId first_cell() const { return plane_cells_ * layer_ * kChunkEdge; }
    /// The slab with one more plane below and above, if the grid has them; ids are counted from
    /// `first_around()`.
    StepValues around() const;
    CellId first_around() const { return plane_cells_ * first_plane_; }
    std::uint32_t first_plane() const { return first_plane_; }
    StepPart part();

  private:
    StepValues planes(std::uint32_t first, std::uint32_t end) const;
    enum State : std::uint8_t { vacant, needed, filled };

    void need(std::uint32_t x, std::uint32_t y, std::uint32_t layer) {
        std::uint8_t& state = state_[layer + 1 - layer_][chunks_->place(x, y)];
        if (state == vacant)
            state = needed;
    }
    void forget_bricks();
    void set_bricks(const Chunk& chunk, std::uint32_t x, std::uint32_t y, BricksOfChunk candidates);
    void fill();
    void copy(std::uint32_t layer, std::span<const std::uint32_t> places,
              std::span<const ChunkPtr> chunks);

    void fit(const StepView& step);

    const StepView* step_ = nullptr;
    const ChunkGrid* chunks_ = nullptr; ///< chunks of the step
    CellId plane_cells_ = 0;
    std::uint32_t layer_ = 0, first_plane_ = 0, end_plane_ = 0;
    LargeMemory values_;     ///< undefined until they are filled
    std::uint64_t room_ = 0; ///< [bytes] of `values_`
    std::vector<std::uint8_t> bricks_;
    std::array<std::vector<std::uint8_t>, 3> state_; ///< by layer (below, this, above) and place
    std::vector<std::uint64_t> sides_;               ///< where the cells of each column lie
    std::vector<const Chunk*> by_column_;            ///< chunks to copy
    bool whole_ = false;                             ///< all chunks are put, or will be
    std::stop_token stop_;
};

} // namespace isochron::index
