// Occlusion culling of splats, for software GL: leaves out splats behind opaque ones.
#pragma once

#include "render/cells/placement.h"
#include "render/cells/slot_plan.h"
#include "render/culling/seen_slots.h"
#include "render/gl/view.h"

#include <cstdint>
#include <span>

namespace isochron::render {

/// Culls splats that are hidden by those in front of them. Each tile of one or a few pixels has an
/// upper bound of the light that the nearer splats let through. If this is below half a step of an
/// 8-bit picture in all tiles that a splat may touch, then the splat and everything behind it do
/// not show.
class SeenSplats final : public SeenSlots {
  public:
    /// @param falloff log2 of the opacity on the footprint's outline, negative; opacity is 1 in the
    /// middle
    /// @param slots with planes if the shape is `CellShape::plane`
    /// @param back_to_front slots in this order
    /// @return slots of the visible splats, back to front; valid until the next call
    std::span<const std::uint32_t> find(const View& view, const Placement& placement,
                                        const SplatShape& shape, float falloff, const Slots& slots,
                                        std::span<const std::uint32_t> back_to_front) {
        begin(view, placement, shape, falloff, slots);
        return advance(work(), slots, back_to_front);
    }

    void begin(const View& view, const Placement& placement, const SplatShape& shape, float falloff,
               const Slots& slots) {
        falloff_ = falloff;
        SeenSlots::begin(view, placement, shape, slots);
    }

  private:
    /// A tile has an upper bound of the light that comes through.
    void lay_out(const View& view, const CellSquares& squares, PictureTiles& tiles) override;
    std::size_t visit(const CellSquares& squares, const TileNumbers& tiles, std::size_t first,
                      std::size_t end, std::uint32_t* seen, PixelSquare* parts) override;
    bool nearest_first() const override { return false; }
    bool finds_parts() const override { return false; }

    float falloff_ = 0;
};

} // namespace isochron::render
