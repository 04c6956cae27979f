// Draws the exact trilinear isosurface of a set of cells, by casting a ray per pixel into each.
#pragma once

#include "render/cells/cell_buffers.h"
#include "render/gl/quad_indices.h"

#include <array>
#include <cstddef>
#include <optional>

namespace isochron::render {

class SurfacePass {
  public:
    /// @param two_views_at_once also makes the programs that draw two views in one pass
    /// @throws Error when a shader does not compile
    SurfacePass(const Gl& gl, bool two_views_at_once);

    /// Draws with the frame, cells, orders and viewports that CellPass has bound, and its depth and
    /// blend state. Writes the depth of the surface, whatever GL's depth range makes of its box.
    /// In a multisampled target every sample has a ray of its own: no side of a triangle is an edge
    /// of the surface, which only the rays tell.
    /// @param blended several layers within a cell are blended far to near, pre-multiplied
    /// @param cells whose corners are computed
    /// @param views 1 or 2
    void draw(const QuadIndices& quads, const CellBuffers& cells, bool blended,
              std::size_t views) const;

  private:
    /// [blended][views - 1]
    using Programs = std::array<std::array<std::optional<Program>, 2>, 2>;

    const Gl* gl_;
    std::array<Programs, 2> programs_; ///< for a ray each pixel, and each sample
};

} // namespace isochron::render
