// Draws a set of cells as fast quads, as Gaussian splats (ShellSplatting), as triangles or as the
// exact surface.
#pragma once

#include "render/cells/cell_appearance.h"
#include "render/cells/cell_buffers.h"
#include "render/cells/corner_window.h"
#include "render/cells/draw_part.h"
#include "render/cells/footprints.h"
#include "render/cells/frame_block.h"
#include "render/cells/placement.h"
#include "render/culling/cells_in_sight.h"
#include "render/drawing/cell_sequence.h"
#include "render/drawing/mesh_pass.h"
#include "render/drawing/surface_pass.h"
#include "render/gl/quad_indices.h"
#include "render/gl/shader.h"
#include "render/gl/view.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::render {

class CellPass {
  public:
    /// @param grid_prelude of the grid whose cells are drawn: `prelude_for`
    /// @throws Error when a shader does not compile
    explicit CellPass(const Gl& gl, const FootprintShapes& shapes = {},
                      const std::string& grid_prelude = {});

    /// Draws the cells into the views' viewports of the bound framebuffer, two views in one pass if
    /// the driver can; does nothing without cells. Quads and opaque surfaces test and write depth.
    /// Splats and translucent surfaces only test depth, and blend over the target with
    /// pre-multiplied alpha. Exact surfaces need the cells' volume on the GPU, and where one
    /// `needs_corners`, `CellBuffers::compute_corners` before; meshes need `CellBuffers::has_mesh`.
    /// Leaves depth test, depth writes and GL_FRAMEBUFFER_SRGB on, blending and culling off, and
    /// the viewport undefined.
    /// @param part of the work: drawn one after the other, all parts give the same picture as the
    /// whole, to the bit
    /// @return work that is done, after which the next part begins: more than the part's where
    /// cells take no time because others hide them
    std::size_t draw(std::span<const View> views, const Placement& placement,
                     const CellBuffers& cells, Footprint footprint,
                     const CellAppearance& appearance = {}, DrawPart part = {});
    void draw(const View& view, const Placement& placement, const CellBuffers& cells,
              Footprint footprint, const CellAppearance& appearance = {}) {
        draw(std::span(&view, 1), placement, cells, footprint, appearance);
    }
    /// Whether these cells are drawn as an exact surface in an order, as where light shines through,
    /// so that the corners of all cells are wanted at a time.
    static bool needs_corners(const CellBuffers& cells, Footprint footprint,
                              const CellAppearance& appearance);

    /// Work of drawing these cells into so many views, counted in cells of the exact surface or
    /// triangles of a mesh; `draw` can do a part of the work. Most cells are first put in order, which
    /// counts as a little work for each cell.
    std::size_t work(std::size_t views, const CellBuffers& cells, Footprint footprint,
                     const CellAppearance& appearance) const;

    /// Whether two views are drawn in one pass: the vertex shader can choose the viewport.
    bool draws_two_views_at_once() const { return two_views_at_once_; }
    /// For comparisons: uses two passes even if the driver can draw two views in one.
    void draw_views_apart() { two_views_at_once_ = false; }
    /// For comparisons: also draws occluded and out-of-view cells on software GL, which are culled
    /// otherwise.
    void draw_hidden_cells() { all_cells_ = true; }
    /// For comparisons: draws quads even where points would show the same faster.
    void draw_without_points() { use_points(false); }
    /// Whether cells may be drawn as points, where these show the same.
    void use_points(bool points) { points_ = points; }

    const OrderCache& orders() const { return sequences_.orders(); }

  private:
    /// Each program for one view and for two.
    struct Programs {
        LazyProgram one;
        std::optional<LazyProgram> two;
    };
    /// Programs for the same footprint drawn as quads, as points, and as points that it fills.
    struct FootprintPrograms {
        Programs quads, points;
        std::optional<Programs> squares;
    };
    Programs programs(std::string_view fragment_shader, const std::string& prelude) const;
    FootprintPrograms footprint_programs(std::string_view fragment_shader,
                                         Footprint footprint) const;
    /// How footprints are drawn, from the most general to the fastest form.
    enum class Form : std::uint8_t { quads, points, squares };
    /// Surfaces that are drawn together.
    struct Layer {
        std::int32_t surfaces = 0; ///< one bit for each
        bool blended = false;
    };

    /// Opaque surfaces come before translucent ones: if both pass through one cell, no order of
    /// cells would be right.
    static std::vector<Layer> layers_of(const CellBuffers& cells, Footprint footprint,
                                        const CellAppearance& appearance);
    /// Views that are drawn in one pass, at most.
    std::size_t views_at_once(Footprint footprint) const;
    std::size_t work_of(const CellBuffers& cells, Footprint footprint, const Layer& layer,
                        std::size_t mesh_level) const;
    /// Surfaces that are drawn into one or two views in one pass; two need `Programs::two`.
    struct Drawing {
        std::span<const View> views;
        const Placement& placement;
        const CellBuffers& cells;
        Footprint footprint;
        Layer layer;
        const CellAppearance& appearance;
    };
    void draw_at_once(const Drawing& drawing, DrawPart part);
    std::size_t draw_in_sight(const Drawing& drawing, DrawPart part);
    /// Sets all state and draws. @param sequences by view
    void draw_cells(const Drawing& drawing, const std::array<CellSequence, 2>& sequences,
                    DrawPart part, bool corners_by_slot);
    /// The fastest form that shows the same picture in all views.
    Form form_of(std::span<const View> views, const Placement& placement, Footprint footprint,
                 const CellBuffers& cells) const;
    /// Whether its cells are drawn in an order, or any will do. Simplified meshes have no cells.
    bool is_ordered(Footprint footprint, bool blended, std::size_t mesh_level) const;
    static bool wants_order_only(Footprint footprint, bool blended);
    SequenceWanted sequence_wanted(const Drawing& drawing, std::size_t eye) const;
    /// Goes on with putting quads and splats in order. @return the part of the work that is left to
    /// draw
    DrawPart put_in_order(const Drawing& drawing, DrawPart part);
    /// The data of the cells' vertices: where blended of all cells, else of those in the window.
    SurfacePass::Corners corners_of(const Drawing& drawing) const {
        const CellBuffers& cells = drawing.cells;
        const GLuint colors = drawing.appearance.values ? cells.corner_colors_texture() : 0;
        if (drawing.layer.blended)
            return {cells.corner_values_texture(), cells.corner_gradients_texture(), colors};
        return {corners_.values_texture(), corners_.gradients_texture(), colors};
    }
    void draw_mesh(const Drawing& drawing, const FrameBlock& frame, DrawPart part);
    void draw_footprints(std::size_t cells, int views, Footprint footprint, Form form);
    float gaussian_falloff() const;

    const Gl* gl_;
    FootprintShapes shapes_;
    std::string grid_prelude_;
    bool two_views_at_once_;
    /// Whether to cull occluded cells, and draw quads and opaque surfaces nearest first: on software
    /// GL this saves far more time than it takes. A GPU is faster with all cells in any order.
    bool seen_only_;
    bool all_cells_ = false; ///< no culling, but still nearest first
    float largest_point_;    ///< [pixel]
    bool points_ = true;     ///< see `use_points`
    FootprintPrograms quad_programs_, gaussian_programs_;
    MeshPass mesh_;
    SurfacePass surface_;
    CornerWindow corners_;  ///< corners of the cells of opaque surfaces
    CellsInSight in_sight_; ///< opaque surfaces' cells that nothing hides
    QuadIndices quads_;
    CellSequences sequences_;
    Buffer frame_;
    Texture no_colors_; ///< in place of a color map
};

} // namespace isochron::render
