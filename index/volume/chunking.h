// Chunks of cells: whole rows of cells that are indexed, built and checked together.
#pragma once

#include "index/volume/grid.h"

#include <algorithm>

namespace isochron::index {

/// A chunk of cells is the largest number of whole rows, in id order, with fewer than 2^16 cells.
/// So ids within it take 16 bits, and it is built from one contiguous range of every step.
class Chunking {
  public:
    static constexpr std::uint32_t kMaxCells = 0xffff;

    /// @param grid with rows of at most kMaxCells cells
    explicit Chunking(const Grid& grid)
        : row_(grid.cells()[0]), rows_(grid.cells()[1] * grid.cells()[2]),
          rows_per_chunk_(std::min(kMaxCells / row_, rows_)) {}

    std::uint32_t count() const { return (rows_ + rows_per_chunk_ - 1) / rows_per_chunk_; }
    /// Rows are numbered y first: row r has y = r % (ny-1), z = r / (ny-1).
    std::uint32_t first_row(std::uint32_t chunk) const { return chunk * rows_per_chunk_; }
    std::uint32_t row_count(std::uint32_t chunk) const {
        return std::min(rows_per_chunk_, rows_ - first_row(chunk));
    }
    CellId first_cell(std::uint32_t chunk) const { return first_row(chunk) * row_; }
    std::uint32_t cells(std::uint32_t chunk) const { return row_count(chunk) * row_; }

  private:
    std::uint32_t row_, rows_, rows_per_chunk_;
};

} // namespace isochron::index
