// Draws a cell once in every way in which cells are drawn.
#include "app/scene/cell_warm_up.h"

namespace isochron::app {

CellWarmUp::CellWarmUp(const render::Gl& gl, const CellDrawing& drawing)
    : small_(gl, drawing.grid, matrix(drawing.picture.room_from_physical), drawing.meshes) {}

void CellWarmUp::draw(std::size_t way, render::CellPass& cells, MovingCells& moving,
                      std::span<const render::View> views, const CellDrawing& drawing) const {
    if (way == 0)
        moving.warm_up(drawing.picture, views, drawing.appearance.linear_light);
    else
        small_.draw(way - 1, cells, views, drawing.appearance);
}

bool CellWarmUp::draws(std::size_t way, render::Footprint footprint, bool translucent,
                       bool by_value) const {
    if (way == 0)
        return false;
    const SmallSurface::Way& small = small_.way(way - 1);
    return small.footprint == footprint &&
           (!render::has_layers(footprint) ||
            ((small.opacity < 1) == translucent && small.by_value == by_value));
}

} // namespace isochron::app
