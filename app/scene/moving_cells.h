// How moving cells are drawn, other than in pictures at rest: the last picture moved, in few
// pixels, and translucent surfaces by their nearest layers.
#pragma once

#include "app/scene/cell_sets.h"
#include "app/scene/cells_picture.h"
#include "app/scene/picture.h"
#include "index/volume/grid.h"
#include "render/cells/cell_appearance.h"
#include "render/drawing/cell_pass.h"
#include "render/passes/enlarge_pass.h"
#include "render/passes/layer_pass.h"
#include "render/passes/reproject_pass.h"

#include <span>

namespace isochron::app {

/// Whether surfaces are drawn by their nearest layers: some let light through, and the picture
/// shows quads or a simplified mesh of them, as pictures that move do.
bool moves_in_layers(const Picture& picture, render::Footprint footprint);

class MovingCells {
  public:
    /// @param gl outlives the ways @param grid of all cells
    MovingCells(const render::Gl& gl, const index::Grid& grid)
        : gl_(gl), grid_(grid), enlarge_(gl), layers_(gl), reproject_(gl) {}

    /// Draws the kept picture, moved to where the cells of `picture` are seen.
    /// @return false: there is none for these screens
    bool draw_moved(const CellsPicture& kept, const Picture& picture,
                    std::span<const render::View> views);
    /// What is drawn, beside the views.
    struct Cells {
        render::CellPass& pass;
        const render::CellBuffers& buffers;
        const render::CellAppearance& appearance;
    };
    /// Draws quads in as few pixels as the picture says, with layers or without.
    void draw_in_few_pixels(const Cells& cells, const Picture& picture,
                            std::span<const render::View> views);
    /// Whether `draw_in_layers` draws layers into the bound framebuffer: of several samples, it draws
    /// a share of the quads.
    bool draws_layers(const Picture& picture, render::Footprint footprint) const;
    /// Draws a mesh or quads by their nearest layers, opaque surfaces as they are.
    void draw_in_layers(const Cells& cells, const Picture& picture, render::Footprint footprint,
                        std::span<const render::View> views);
    /// Draws something small in each of these ways, so that drivers compile their shaders.
    void warm_up(const Picture& picture, std::span<const render::View> views, bool linear_light);

  private:
    render::Placement placement_of(const Picture& picture) const;
    glm::mat4 box_of(const Picture& picture) const;

    const render::Gl& gl_;
    const index::Grid grid_;
    render::EnlargePass enlarge_;
    render::LayerPass layers_;
    render::ReprojectPass reproject_;
};

} // namespace isochron::app
