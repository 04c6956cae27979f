// Which cells of a view are worth drawing where the processor draws: those behind others are not.
#pragma once

#include "render/placement.h"
#include "render/slot_plan.h"
#include "render/view.h"

#include <cstdint>
#include <span>
#include <vector>

namespace isochron::render {

/// Finds opaque quads that lie wholly behind others' or beside the view. The picture is held as
/// tiles of a few pixels with the depth of the nearest quad that covers all of the tile (as the
/// tiles of a hierarchical z-buffer; Greene, Kass and Miller 1993, doi:10.1145/166117.166147): a
/// cell is hidden where all tiles that its quad may touch are covered by nearer ones. What is left
/// shows exactly the same picture. On the processor that takes some 40 ns a cell, drawing one takes
/// 500 to 1000.
class SeenCells {
  public:
    /// @param radius of the footprint, voxels
    /// @param places of the cells by slot
    /// @param back_to_front slots
    /// @return the slots of the others, nearest first; until the next call
    std::span<const std::uint32_t> find(const View& view, const Placement& placement, float radius,
                                        std::span<const CellPlace> places,
                                        std::span<const std::uint32_t> back_to_front);

  private:
    /// Two upright squares about the middle of a quad: one that it holds and one that holds it.
    struct Quad {
        float x, y, z;      ///< middle in pixels of the viewport, depth
        float inner, outer; ///< half sides in pixels
    };
    /// An inclusive range of tiles along one axis; empty where `last` is less than `first`.
    struct Tiles {
        int first, last;
    };
    void project(const View& view, const Placement& placement, float radius,
                 std::span<const CellPlace> places, std::span<const std::uint32_t> back_to_front);
    void choose_tiles(const View& view);
    Tiles touched(float middle, float half, int count) const;
    Tiles covered(float middle, float half, int count) const;
    bool hidden(const Quad& quad, Tiles across, Tiles up) const;

    std::vector<Quad> quads_; ///< nearest first
    int tile_bits_ = 0;       ///< tiles have 1 << tile_bits_ pixels across and up
    int columns_ = 0, rows_ = 0;
    std::vector<float> nearest_; ///< depth by tile, row by row
    std::vector<std::uint32_t> seen_;
};

} // namespace isochron::render
