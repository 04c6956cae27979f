// Computes the coordinates of ascending cell ids, mostly without divisions.
#pragma once

#include "index/volume/grid.h"

#include <cstdint>

namespace isochron::index {

/// Visits cells in the order of their ids.
class CellWalk {
  public:
    explicit CellWalk(const Grid& grid)
        : grid_(grid), width_(grid.cells()[0]), height_(grid.cells()[1]) {}

    /// Moves to a cell. @param id larger than the one before
    /// @return whether the cell is the first visited one of its row (the same y and z)
    bool to(CellId id) {
        const bool new_row = id >= row_end_;
        if (new_row)
            enter_row_of(id);
        x_ = static_cast<std::uint32_t>(id - (row_end_ - width_));
        return new_row;
    }
    std::uint32_t x() const { return x_; }
    std::uint32_t y() const { return y_; }
    std::uint32_t z() const { return z_; }

  private:
    void enter_row_of(CellId id) {
        // Mostly it is the next row, which needs no divisions.
        if (row_end_ > 0 && id - row_end_ < width_ && y_ + 1 < height_) {
            ++y_;
            row_end_ += width_;
        } else {
            const auto at = grid_.cell_of(id);
            y_ = at[1];
            z_ = at[2];
            row_end_ = std::uint64_t{id} - at[0] + width_;
        }
    }

    Grid grid_;
    std::uint32_t width_, height_;
    std::uint64_t row_end_ = 0; ///< first id after the row; 0 before the first cell
    std::uint32_t x_ = 0, y_ = 0, z_ = 0;
};

} // namespace isochron::index
