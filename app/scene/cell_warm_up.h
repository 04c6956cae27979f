// Draws a cell once in every way in which cells are drawn, so that drivers compile their shaders.
#pragma once

#include "app/scene/moving_cells.h"
#include "app/scene/picture.h"
#include "app/scene/small_surface.h"
#include "index/volume/grid.h"
#include "render/cells/cell_appearance.h"
#include "render/cells/footprints.h"
#include "render/drawing/cell_pass.h"
#include "render/gl/view.h"

#include <cstddef>
#include <span>
#include <string>

namespace isochron::app {

/// What decides how cells are drawn, beside the context that draws them.
struct CellDrawing {
    index::Grid grid;
    render::FootprintShapes shapes;
    std::string prelude; ///< see render::CellPass
    bool meshes = false; ///< surfaces may have meshes
    Picture picture;     ///< where they are
    render::CellAppearance appearance;
};

class CellWarmUp {
  public:
    /// @param gl outlives it
    CellWarmUp(const render::Gl& gl, const CellDrawing& drawing);

    /// Way 0 is how cells move, each other one is a way of `SmallSurface`.
    std::size_t ways() const { return small_.ways() + 1; }
    /// @param cells, moving which are to be ready, in the context that is current
    void draw(std::size_t way, render::CellPass& cells, MovingCells& moving,
              std::span<const render::View> views, const CellDrawing& drawing) const;
    /// Whether a way draws with this footprint, in surfaces that are alike.
    bool draws(std::size_t way, render::Footprint footprint, bool translucent, bool by_value) const;

  private:
    SmallSurface small_;
};

} // namespace isochron::app
