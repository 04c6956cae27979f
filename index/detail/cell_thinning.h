// Leaves out some cells where there are too many, the same ones in every picture.
//
//     const CellThinning thinning(cells.size(), most);
//     std::erase_if(cells, [&](const CellPoint& cell) { return !thinning.keeps({cell.x, cell.y, cell.z}); });
#pragma once

#include <array>
#include <cstdint>

namespace isochron::index {

/// Leaves out some things of a group by hashes of their places: those with the lowest hashes stay.
/// Whether a place stays depends only on the place and on the share that stays: what stays with a
/// smaller share also stays with a larger one, in every step, surface, process and replay, and
/// nothing flickers.
class CellThinning {
  public:
    /// About `most` of `all` stay: all of them where they are not more.
    CellThinning(std::uint64_t all, std::uint64_t most);

    bool keeps_all() const { return end_ > UINT32_MAX; }
    /// @param place for example of a cell, by its coordinates
    bool keeps(const std::array<std::uint32_t, 3>& place) const;

  private:
    std::uint64_t end_; ///< end of the hashes that stay, 0 to 2^32
};

} // namespace isochron::index
