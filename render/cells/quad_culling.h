// Which cells of a view are worth drawing where the processor draws: those behind others are not.
#pragma once

#include "render/cells/cell_squares.h"
#include "render/cells/picture_tiles.h"
#include "render/cells/placement.h"
#include "render/cells/slot_plan.h"
#include "render/gl/view.h"

#include <cstdint>
#include <span>
#include <vector>

namespace isochron::render {

/// Finds opaque quads that lie wholly behind others' or beside the view. The picture is held as
/// tiles of a few pixels with the depth of the nearest quad that covers all of the tile (as the
/// tiles of a hierarchical z-buffer; Greene, Kass and Miller 1993, doi:10.1145/166117.166147): a
/// cell is hidden where all tiles that its quad may touch are covered by nearer ones. What is left
/// shows exactly the same picture. On the processor that takes some 20 ns a cell, drawing one takes
/// 500 to 1000.
class SeenCells {
  public:
    /// @param slots with their planes, where the shape is one
    /// @param back_to_front slots
    /// @return the slots of the others, nearest first; until the next call
    std::span<const std::uint32_t> find(const View& view, const Placement& placement,
                                        const SplatShape& shape, const Slots& slots,
                                        std::span<const std::uint32_t> back_to_front);

  private:
    CellSquares squares_;
    PictureTiles tiles_; ///< with the depth of the nearest quad that covers all of the tile
    std::vector<std::uint32_t> seen_;
};

} // namespace isochron::render
