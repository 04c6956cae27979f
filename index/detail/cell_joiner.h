// Joins small cells to larger ones, as many levels of detail up as it takes until they are few.
//
//     CellJoiner joiner(std::move(cells), stop);
//     while (joiner.cells() > most)
//         joiner.rise();
//     const JoinedCells few = joiner.join();
#pragma once

#include "index/surface/cell_set.h"

#include <cstddef>
#include <cstdint>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// Cells and their colors.
struct JoinedCells {
    std::vector<CellPoint> points; ///< at places of mixed levels
    std::vector<std::uint16_t> colors;
};

/// Joins small cells: all that lie in the same cell of the joiner's level and are smaller than it
/// are replaced by that large cell. The large cell's plane has the direction of the sum of the
/// small cells' normals, and no offset. If this sum is shorter than half the number of small cells,
/// they surround something: then the large cell gets no plane and is drawn as a ball. Its color is
/// the color of the middle one of the small cells.
/// It is fastest with cells in order of z. Functions throw Stopped when asked to stop.
class CellJoiner {
  public:
    /// Begins at level 0, where no cell is small. @param cells with a color each
    CellJoiner(JoinedCells cells, std::stop_token stop);

    unsigned level() const { return level_; }
    /// Turns to the next coarser level.
    void rise();
    /// The number of cells that `join` makes.
    std::size_t cells() const { return large_ + parents_.size(); }
    /// First the cells that are not small, in their order; then those made of small ones, by z, y, x.
    JoinedCells join() const;

  private:
    JoinedCells cells_;
    std::stop_token stop_;
    unsigned level_ = 0;
    std::uint32_t levels_ = 0;           ///< a bit for each level that has some of the cells
    std::size_t large_;                  ///< number of cells that are not small
    std::vector<std::uint64_t> parents_; ///< cells of the level that hold small ones, ascending
};

} // namespace isochron::index
