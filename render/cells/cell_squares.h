// Where cells' quads lie in a view, many cells at a time.
#pragma once

#include "render/cells/cell_shape.h"
#include "render/cells/placement.h"
#include "render/cells/slot_plan.h"
#include "render/gl/view.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::render {

/// For each cell two upright squares about the middle of its quad, as cell.vert makes it: one that
/// the quad holds and one that holds the quad; and two such discs of its ellipse. What is beside or
/// behind the view is far away; for what is too near to say so the outer ones are as large as
/// everything. Of ellipsoids on planes, which are drawn as ellipses, there are the ellipses
/// themselves instead of the squares.
class CellSquares {
  public:
    static constexpr std::size_t kBlock = 16; ///< the arrays go on to whole blocks

    /// @param slots with their planes, where the shape is one
    /// @param back_to_front slots
    void project(const View& view, const Placement& placement, const SplatShape& shape,
                 const Slots& slots, std::span<const std::uint32_t> back_to_front);

    std::size_t size() const { return size_; }
    // Nearest first:
    const float* x() const { return x_.data(); } ///< of the middle [pixel of the viewport]
    const float* y() const { return y_.data(); }
    const float* z() const { return z_.data(); } ///< clip depth
    /// Half a side [pixel]; 0 where no such square is known, or where it hides nothing.
    const float* inner() const { return inner_.data(); }
    const float* outer() const { return outer_.data(); }
    /// Radii [pixel]. The inner one is 0 also where the vertex shader fades what is near the eye.
    const float* inner_disc() const { return inner_disc_.data(); }
    const float* outer_disc() const { return outer_disc_.data(); }
    /// Of ellipsoids on planes: the ellipse's shape F F^T, with its half axes as the columns of F
    /// [square pixels].
    const float* xx() const { return xx_.data(); }
    const float* xy() const { return xy_.data(); }
    const float* yy() const { return yy_.data(); }

  private:
    std::size_t size_ = 0;
    std::vector<std::uint32_t> words_; ///< two for each cell: those of its CellPlace
    std::vector<std::uint32_t> planes_;
    std::vector<float> x_, y_, z_, inner_, outer_, inner_disc_, outer_disc_, xx_, xy_, yy_;
};

} // namespace isochron::render
