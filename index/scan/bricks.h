// Bricks: quantized extremes of small blocks of cells at every step, and the exact search with
// them.
//
//     const index::BrickGrid grid(values.grid);
//     std::vector<std::uint8_t> bricks(grid.bytes_per_step());        // for each step
//     index::build_bricks(values, levels, step, bricks);
//     index::search_bricks(values, levels, bricks, {index::Instant(step), isovalue}, ids);
//
// They take two bytes for 128 cells: 0.065 % of 24 bytes for each cell. Any levels give exact
// results, since all cells of a brick that may hold active ones are tested in the volume.
#pragma once

#include "index/volume/level_map.h"
#include "index/volume/query.h"
#include "index/volume/step_values.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// The bricks of a grid, x fastest, then y, then z; bricks at the upper borders are clipped.
class BrickGrid {
  public:
    /// Cells of a brick along x, y and z.
    static constexpr std::array<std::uint32_t, 3> kCells{8, 4, 4};

    explicit BrickGrid(const Grid& grid) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            bricks_[axis] = (grid.cells()[axis] + kCells[axis] - 1) / kCells[axis];
    }

    const std::array<std::uint32_t, 3>& bricks() const { return bricks_; }
    std::size_t count() const { return std::size_t{bricks_[0]} * bricks_[1] * bricks_[2]; }
    std::size_t bytes_per_step() const { return 2 * count(); }

  private:
    std::array<std::uint32_t, 3> bricks_{};
};

/// Computes the ranks of the lowest and the highest value of each brick's vertices at a step, its
/// border included. NaN are ignored; a brick with nothing but NaN gets 255 and 0.
/// @param out `bytes_per_step()` bytes: the lowest of all bricks, then the highest of all bricks
void build_bricks(const StepValues& values, const LevelMap& levels, std::size_t step,
                  std::span<std::uint8_t> out);

/// Appends the active cells: the same as `scan` finds, but brick by brick, in ascending order
/// within each. If so many bricks may hold active cells that a scan is faster, it scans, and all
/// cells are in ascending order.
/// @param bricks of the query's step, as from `build_bricks` with these levels
/// @return number of cells that were tested; after a scan, the number of cells found
std::uint64_t search_bricks(const StepValues& values, const LevelMap& levels,
                            std::span<const std::uint8_t> bricks, const Query& query,
                            std::vector<CellId>& out);

/// Like `search_bricks`, but never scans: reads only the vertices of bricks that may hold active
/// cells.
/// @return number of cells that were tested
std::uint64_t test_bricks(const StepValues& values, const LevelMap& levels,
                          std::span<const std::uint8_t> bricks, const Query& query,
                          std::vector<CellId>& out);

} // namespace isochron::index
