// The regions of a volume that each have one level of detail in a picture, and the cells of mixed
// levels.
#pragma once

#include "index/file/chunks/chunk_grid.h"
#include "index/surface/cell_set.h"
#include "index/volume/grid.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// Cuts the cells of the volume into cubes, whose edge is a power of two and a multiple of the
/// chunks of the file; the last ones along an axis are clipped. At most 16 along each axis.
class DetailRegions {
  public:
    explicit DetailRegions(const Grid& grid);

    std::uint32_t edge() const { return edge_; } ///< [cells of level 0]
    /// The coarsest level whose cells fit into a region.
    unsigned coarsest() const { return static_cast<unsigned>(std::countr_zero(edge_)); }
    const std::array<std::uint32_t, 3>& counts() const { return counts_; } ///< along x, y and z
    std::size_t size() const { return std::size_t{counts_[0]} * counts_[1] * counts_[2]; }
    /// Number of the region, x fastest. @param at coordinates among the regions
    std::size_t number(const std::array<std::uint32_t, 3>& at) const {
        return (std::size_t{at[2]} * counts_[1] + at[1]) * counts_[0] + at[0];
    }
    std::array<std::uint32_t, 3> at(std::size_t number) const {
        const auto n = static_cast<std::uint32_t>(number);
        return {n % counts_[0], n / counts_[0] % counts_[1], n / counts_[0] / counts_[1]};
    }
    /// Coordinate among the regions along an axis of a cell of a level, at most the last one.
    std::uint32_t along(std::size_t axis, std::uint32_t cell, unsigned level) const {
        return std::min((cell << level) / edge_, counts_[axis] - 1);
    }

    /// The levels if all wishes (DetailQuery::wished, which may be empty) are made coarser by so
    /// many parts of a level: 0 to `most`.
    std::vector<std::uint8_t> levels(std::span<const std::int8_t> wished, unsigned coarser,
                                     unsigned most) const;

    /// Numbers of all regions, from the middle of the volume outwards.
    std::vector<std::uint32_t> from_the_middle() const;

    /// Whether a cell of a level is drawn: if its region has this level; or if its region is finer,
    /// but a region beside the cell has this level. So the cells of a region reach one cell into
    /// the finer regions around it, and no gap shows between the two surfaces.
    bool draws(std::span<const std::uint8_t> levels, unsigned level,
               const std::array<std::uint32_t, 3>& cell) const;

    /// The chunks of a level, layer by layer, that hold drawn cells of this level.
    std::vector<bool> chunks_of(std::span<const std::uint8_t> levels, unsigned level,
                                const ChunkGrid& chunks) const;

  private:
    std::uint32_t edge_;
    std::array<std::uint32_t, 3> counts_;
};

/// A cell of mixed levels has twice its center as its position: an odd multiple of 2^level along
/// each axis, in level 0 cells. So the position alone says where the cell is and how large. The
/// last cell along an axis reaches to the border of the volume only, though its position is made as
/// if it were as large as the others.
constexpr std::uint32_t doubled_center(std::uint32_t cell, unsigned level) {
    return (2 * cell + 1) << level;
}
constexpr unsigned level_of_center(std::uint32_t doubled) {
    return static_cast<unsigned>(std::countr_zero(doubled));
}
/// Whether the positions of all cells of all levels fit into a CellPoint.
bool has_mixed_levels(const Grid& grid);

} // namespace isochron::index
