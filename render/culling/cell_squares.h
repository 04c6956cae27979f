// Projects cells' quads to a view, many cells at a time.
#pragma once

#include "render/cells/axis_places.h"
#include "render/cells/cell_shape.h"
#include "render/cells/placement.h"
#include "render/cells/slot_assignment.h"
#include "render/culling/square_projection.h"
#include "render/gl/view.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace isochron::render {

/// For each cell: two upright squares around the middle of its quad (as cell.vert makes it), one
/// inside the quad and one around it; and two discs, one inside its ellipse and one around it.
/// Cells behind the eye lie far outside the view. For cells too near to the eye the outer shapes
/// cover everything. Of quads on planes there are the outlines themselves instead.
class CellSquares {
  public:
    static constexpr std::size_t kBlock = 16; ///< the arrays are padded to whole blocks

    /// Projects all cells.
    /// @param slots with planes if the shape is `CellShape::plane`
    /// @param back_to_front slots in this order
    void project(const View& view, const Placement& placement, const SplatShape& shape,
                 const Slots& slots, std::span<const std::uint32_t> back_to_front) {
        begin(view, placement, shape, slots);
        project_to(size_, slots, back_to_front);
    }

    /// Projects in pieces: begins, with no cell projected yet.
    void begin(const View& view, const Placement& placement, const SplatShape& shape,
               const Slots& slots);
    /// Goes on until the nearest `to` cells, or a few more, are projected. @param slots the same
    /// each time, as is `back_to_front`
    void project_to(std::size_t to, const Slots& slots,
                    std::span<const std::uint32_t> back_to_front);

    std::size_t size() const { return size_; }
    // Nearest first:
    const float* x() const { return x_.data(); } ///< x of the middle [pixel of the viewport]
    const float* y() const { return y_.data(); }
    const float* z() const { return z_.data(); } ///< clip depth
    /// Half the length of a side [pixel]; `inner` is 0 if no inner square is known, or it hides
    /// nothing.
    const float* inner() const { return inner_.data(); }
    const float* outer() const { return outer_.data(); }
    /// Radii [pixel]. The inner one is 0 also if the vertex shader fades the cell near the eye.
    const float* inner_disc() const { return inner_disc_.data(); }
    const float* outer_disc() const { return outer_disc_.data(); }
    /// The ends of the rows between which a quad on a plane lies [pixel of the
    /// viewport], the upper one first beyond the lower one if there is nothing of it.
    const float* low() const { return low_.data(); }
    const float* high() const { return high_.data(); }
    /// Such a quad lies in three stripes, one for each axis of the cell; `x` and `y` are a place in
    /// all of them, and `inner_disc` is half a side of a square of about the quad's area.
    struct Stripe {
        const float* middle; ///< to the right of `x`, in the row of `y` [pixel]
        const float* lean;   ///< how far it moves to the right for each pixel up
        const float* half;   ///< half its width [pixel]
    };
    Stripe stripe(std::size_t axis) const {
        const auto& [middle, lean, half] = stripes_[axis];
        return {middle.data(), lean.data(), half.data()};
    }

  private:
    void take_axes(const Placement& placement);

    std::size_t size_ = 0, done_ = 0;
    SquareProjection projection_{};
    CellKind kind_{};
    std::optional<index::Grid> grid_; ///< the grid of `axes_`, if it is rectilinear
    std::array<AxisPlaces, 3> axes_;
    std::vector<std::uint32_t> words_; ///< two for each cell: the words of its CellPlace
    std::vector<std::uint32_t> planes_;
    std::vector<float> x_, y_, z_, inner_, outer_, inner_disc_, outer_disc_, low_, high_;
    std::array<std::array<std::vector<float>, 3>, 3> stripes_;
};

} // namespace isochron::render
