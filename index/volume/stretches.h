// Stretches: whole rows of cells that are indexed, built and checked together.
#pragma once

#include "index/volume/grid.h"

#include <algorithm>

namespace isochron::index {

/// A stretch is the largest number of whole rows, in id order, with fewer than 2^16 cells.
/// So ids within it take 16 bits, and it is built from one contiguous range of every step.
class Stretches {
  public:
    static constexpr std::uint32_t kMaxCells = 0xffff;

    /// @param grid with rows of at most kMaxCells cells
    explicit Stretches(const Grid& grid)
        : row_(grid.cells()[0]), rows_(grid.cells()[1] * grid.cells()[2]),
          rows_per_stretch_(std::min(kMaxCells / row_, rows_)) {}

    std::uint32_t count() const { return (rows_ + rows_per_stretch_ - 1) / rows_per_stretch_; }
    /// Rows are numbered y first: row r has y = r % (ny-1), z = r / (ny-1).
    std::uint32_t first_row(std::uint32_t stretch) const { return stretch * rows_per_stretch_; }
    std::uint32_t row_count(std::uint32_t stretch) const {
        return std::min(rows_per_stretch_, rows_ - first_row(stretch));
    }
    CellId first_cell(std::uint32_t stretch) const { return first_row(stretch) * row_; }
    std::uint32_t cells(std::uint32_t stretch) const { return row_count(stretch) * row_; }

  private:
    std::uint32_t row_, rows_, rows_per_stretch_;
};

} // namespace isochron::index
