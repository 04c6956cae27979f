// Which splats of a view are worth drawing where the processor draws: what is behind opaque ones is
// not.
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

/// Finds splats that nobody sees through those before them. The picture is held as tiles of a pixel
/// or a few with a bound of the light that the nearer splats let through: where it is below half of
/// an eighth bit's step in all tiles that a splat may touch, what the splat adds, together with all
/// that lies behind it, does not show in a picture of eight bits.
class SeenSplats {
  public:
    /// Of opaque splats.
    /// @param falloff log2 of the opacity on the footprint's outline, negative; 1 in the middle
    /// @param slots with their planes, where the shape is one
    /// @param back_to_front slots
    /// @return the slots of the others, back to front; until the next call
    std::span<const std::uint32_t> find(const View& view, const Placement& placement,
                                        const SplatShape& shape, float falloff, const Slots& slots,
                                        std::span<const std::uint32_t> back_to_front);

  private:
    CellSquares squares_;
    PictureTiles tiles_; ///< with a bound of the light that comes through
    std::vector<std::uint32_t> seen_;
};

} // namespace isochron::render
