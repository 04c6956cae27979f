// The vertices of one chunk and the nearest ones around it, side by side in the nearest cache.
#pragma once

#include "index/file/step_view.h"
#include "index/search/chunk_reach.h"
#include "index/volume/step_values.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace isochron::index {

/// A chunk with the vertex below and the two above it along each axis, as far as the grid goes:
/// what its cells and their normals need. Keeps its memory.
class ChunkCube {
  public:
    /// Moves to a chunk. The copies of the earlier chunk are gone.
    /// @param at coordinates of the chunk
    void begin(const StepView& step, const std::array<std::uint32_t, 3>& at);
    /// Copies the part of a chunk that lies in the cube: the chunk at an offset (bit of
    /// ChunksAround). @param chunk from `StepView::cube_chunks`; of a pair that part alone is blended
    void copy(unsigned bit, const Chunk& chunk);

    /// The whole cube, as a grid of its own. Where the cube reaches the border of the whole grid,
    /// its border counts as one. Values that were not copied have no meaning.
    const StepValues& values() const { return values_; }
    /// The place in it of the chunk's first vertex.
    const std::array<std::uint32_t, 3>& first() const { return first_; }
    /// The chunk's cells, at most kChunkEdge along each axis.
    const std::array<std::uint32_t, 3>& cells() const { return cells_; }

  private:
    /// Memory of the cube, and of a part that is blended.
    std::vector<std::uint64_t> memory_, part_;
    StepValues values_;
    const Blend* blend_ = nullptr; ///< blend of pairs; null at a step
    std::size_t stored_ = 0;       ///< bytes of a value of theirs
    std::array<std::uint32_t, 3> first_{}, cells_{};
};

} // namespace isochron::index
