// Which cells of a set are seen in a view, found all at once or in pieces.
#pragma once

#include "render/cells/placement.h"
#include "render/cells/slot_assignment.h"
#include "render/culling/cell_squares.h"
#include "render/culling/culling.h"
#include "render/culling/picture_tiles.h"
#include "render/gl/view.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace isochron::render {

/// Projects the cells, then visits them nearest first with tiles that know what nearer ones hide.
/// With opaque quads, the cells that are left give exactly the same picture; with splats, the same
/// to within a step of an 8-bit picture. This takes 20 to 100 ns per quad on the processor; drawing
/// one takes 200 to 1000 ns.
class SeenSlots {
  public:
    /// Begins with a view: nothing is done yet.
    /// @param slots with planes if the shape is `CellShape::plane`
    /// @param falloff of splats: log2 of the opacity on the footprint's outline; else opaque quads
    void begin(const View& view, const Placement& placement, const SplatShape& shape,
               const Slots& slots, std::optional<float> falloff = {});
    /// All work: every cell is projected and visited.
    std::size_t work() const { return (1 + kVisit) * squares_.size(); }
    /// Goes on until so much of the work is done.
    /// @param slots the same as before
    /// @param back_to_front slots in this order, the same as before
    /// @return slots of the visible cells once all is done, quads nearest first and splats back to
    /// front; valid until the next call
    std::span<const std::uint32_t> advance(std::size_t to, const Slots& slots,
                                           std::span<const std::uint32_t> back_to_front);
    /// All at once.
    std::span<const std::uint32_t> find(const View& view, const Placement& placement,
                                        const SplatShape& shape, const Slots& slots,
                                        std::span<const std::uint32_t> back_to_front,
                                        std::optional<float> falloff = {}) {
        begin(view, placement, shape, slots, falloff);
        return advance(work(), slots, back_to_front);
    }
    /// What is seen of each quad that is cut at its cell, once all slots are done: a square around
    /// the part of the quad that nearer cells do not hide; empty for other cells. Valid as long as
    /// the slots.
    std::span<const PixelSquare> parts() const {
        return kind_ == Kind::cuts ? std::span<const PixelSquare>(parts_).first(seen_.size())
                                   : std::span<const PixelSquare>();
    }

  private:
    static constexpr std::size_t kVisit = 3; ///< times the work of projecting it, for a cell
    enum class Kind : std::uint8_t { squares, cuts, splats };

    void lay_out_tiles();
    std::size_t visit(CellRange range);

    Kind kind_ = Kind::squares;
    float falloff_ = 0;
    View view_;
    CellSquares squares_;
    PictureTiles tiles_;
    std::size_t projected_ = 0, visited_ = 0, count_ = 0;
    std::vector<std::uint32_t> seen_;
    std::vector<PixelSquare> parts_;
};

} // namespace isochron::render
