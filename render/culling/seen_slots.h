// Which cells of a set are seen in a view, found all at once or in pieces.
#pragma once

#include "render/cells/placement.h"
#include "render/cells/slot_plan.h"
#include "render/culling/cell_squares.h"
#include "render/culling/picture_tiles.h"
#include "render/gl/view.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::render {

/// A square of whole pixels of the viewport.
struct PixelSquare {
    std::uint32_t corner = 0; ///< its lower left pixel: x, and y from bit 16 on
    std::uint32_t size = 0;   ///< of its sides [pixel]; 0 where it is not known
};

/// Projects the cells, then visits them nearest first with tiles that know what nearer ones hide.
class SeenSlots {
  public:
    /// Begins with a view: nothing is done yet.
    /// @param slots with planes if the shape is `CellShape::plane`
    void begin(const View& view, const Placement& placement, const SplatShape& shape,
               const Slots& slots);
    /// All work: every cell is projected and visited.
    std::size_t work() const { return (1 + kVisit) * squares_.size(); }
    /// Goes on until so much of the work is done.
    /// @param slots the same as before
    /// @param back_to_front slots in this order, likewise
    /// @return slots of the visible cells once all is done; valid until the next call
    std::span<const std::uint32_t> advance(std::size_t to, const Slots& slots,
                                           std::span<const std::uint32_t> back_to_front);
    /// Of each visible cell, once all is done, a square around all that others do not hide of it;
    /// empty if that is not known. Valid as long as the slots.
    std::span<const PixelSquare> parts() const {
        return finds_parts() ? std::span<const PixelSquare>(parts_).first(seen_.size())
                             : std::span<const PixelSquare>();
    }

  protected:
    ~SeenSlots() = default;
    /// Chooses tiles for the projected cells.
    virtual void lay_out(const View& view, const CellSquares& squares, PictureTiles& tiles) = 0;
    /// Visits the cells from number `first` to `end` in the order of the squares; `first` is a
    /// multiple of `CellSquares::kBlock`.
    /// @param seen takes the numbers of the visible ones
    /// @param parts takes what is seen of each, if `finds_parts`
    /// @return how many these are
    virtual std::size_t visit(const CellSquares& squares, const TileNumbers& tiles,
                              std::size_t first, std::size_t end, std::uint32_t* seen,
                              PixelSquare* parts) = 0;
    virtual bool nearest_first() const = 0; ///< the order of what is found
    virtual bool finds_parts() const = 0;   ///< only nearest first

  private:
    static constexpr std::size_t kVisit = 3; ///< times the work of projecting it, for a cell

    View view_;
    CellSquares squares_;
    PictureTiles tiles_;
    std::size_t projected_ = 0, visited_ = 0, count_ = 0;
    std::vector<std::uint32_t> seen_;
    std::vector<PixelSquare> parts_;
};

} // namespace isochron::render
