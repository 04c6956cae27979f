// Draws the exact trilinear isosurface of a set of cells, by casting rays into each cell.
#pragma once

#include "render/cells/draw_part.h"
#include "render/gl/quad_indices.h"
#include "render/gl/shader.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace isochron::render {

class SurfacePass {
  public:
    /// @param two_views_at_once also has the programs that draw two views in one pass
    /// @param grid_prelude see CellPass
    SurfacePass(const Gl& gl, bool two_views_at_once, const std::string& grid_prelude);

    /// Draws with the frame, cells, orders and viewports that CellPass has bound, and its depth and
    /// blend state. The fragment shader writes the surface's own depth; glDepthRange has no effect.
    /// In a multisampled target every sample has its own ray: the edges of the surface are found
    /// only by rays, not by edges of triangles.
    /// @param blended several layers within a cell are blended from far to near, pre-multiplied
    /// @param corners textures as `CellBuffers` has them; values and gradients, where cells have no
    /// order, from the first one that is drawn on; colors 0: each cell has one color
    /// @param views 1 or 2
    /// @param part of the cells, in the order in which they are drawn
    struct Corners {
        GLuint values, gradients, colors;
    };
    void draw(const QuadIndices& quads, const Corners& corners, bool blended, std::size_t views,
              DrawPart part) const;

  private:
    /// [blended][views - 1]
    using Programs = std::array<std::array<std::optional<LazyProgram>, 2>, 2>;

    const Gl* gl_;
    /// [with colors at vertices][one ray per pixel; one ray per sample]
    std::array<std::array<Programs, 2>, 2> programs_;
};

} // namespace isochron::render
