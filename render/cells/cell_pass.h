// Draws a set of cells as fast quads, as Gaussian splats (ShellSplatting), as triangles or as the
// exact surface.
#pragma once

#include "render/cells/cell_appearance.h"
#include "render/cells/cell_buffers.h"
#include "render/cells/footprints.h"
#include "render/cells/frame_block.h"
#include "render/cells/mesh_pass.h"
#include "render/cells/order_cache.h"
#include "render/cells/placement.h"
#include "render/cells/quad_culling.h"
#include "render/cells/splat_culling.h"
#include "render/cells/surface_pass.h"
#include "render/gl/quad_indices.h"
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
    /// @throws Error when a shader does not compile
    explicit CellPass(const Gl& gl, const FootprintShapes& shapes = {});

    /// Draws the cells into the views' viewports of the bound framebuffer, two views in one pass
    /// where the driver can; nothing where there are none. Quads and opaque surfaces test and write
    /// depth; splats and surfaces of less opacity test it only, and blend over what is there with
    /// pre-multiplied alpha. Surfaces are drawn from the corners that the cells have computed, and
    /// meshes where the cells have them.
    /// Leaves depth test, depth writes and GL_FRAMEBUFFER_SRGB on, blending and culling off, and
    /// the viewport undefined.
    void draw(std::span<const View> views, const Placement& placement, const CellBuffers& cells,
              Footprint footprint, const CellAppearance& appearance = {});
    void draw(const View& view, const Placement& placement, const CellBuffers& cells,
              Footprint footprint, const CellAppearance& appearance = {}) {
        draw(std::span(&view, 1), placement, cells, footprint, appearance);
    }

    /// Whether two views are drawn in one pass: the vertex shader can choose the viewport.
    bool draws_two_views_at_once() const { return two_views_at_once_; }
    /// For comparisons: two passes although the driver could do with one.
    void draw_views_apart() { two_views_at_once_ = false; }
    /// For comparisons: on software GL, too, quads and splats that nobody sees behind others or
    /// beside the view.
    void draw_hidden_cells() { all_cells_ = true; }
    /// For comparisons: quads also where points would show the same faster.
    void draw_without_points() { largest_point_ = 0.0f; }

    const OrderCache& orders() const { return orders_; }

  private:
    /// The same shaders for one view and for two.
    struct Programs {
        Program one;
        std::optional<Program> two;
    };
    /// The same footprint drawn as quads, as points, and as points that are all footprint.
    struct FootprintPrograms {
        Programs quads, points;
        std::optional<Programs> squares;
    };
    Programs programs(std::string_view fragment_shader, const std::string& prelude) const;
    FootprintPrograms footprint_programs(std::string_view fragment_shader, bool round) const;
    /// Whether cells are ellipses rather than the rectangles around them.
    bool is_round(Footprint footprint) const;
    /// What footprints are drawn as, from the most general to the fastest.
    enum class Form : std::uint8_t { quads, points, squares };
    /// Which cells a view draws, and in which order: the n-th is the one that the texel
    /// `begin + n * step` names, or in slot n where there is no texture.
    struct Sequence {
        std::size_t cells = 0;
        GLuint texture = 0;
        int begin = 0, step = 0;
    };

    /// Surfaces that are drawn together.
    struct Layer {
        std::int32_t surfaces = 0; ///< a bit for each
        bool blended = false;
    };

    /// Opaque surfaces before those that let them be seen: where both pass through one cell, no
    /// order of cells would do.
    static std::vector<Layer> layers_of(const CellBuffers& cells, Footprint footprint,
                                        const CellAppearance& appearance);
    /// At most two, of which the second needs `Programs::two`.
    void draw_at_once(std::span<const View> views, const Placement& placement,
                      const CellBuffers& cells, Footprint footprint, const Layer& layer,
                      const CellAppearance& appearance);
    /// The fastest that shows the same in all views.
    Form form_of(std::span<const View> views, const Placement& placement,
                 Footprint footprint) const;
    /// Of one of the views that are drawn at once; `Sequence::cells` is the same in all of them.
    Sequence sequence_of(const View& view, const Placement& placement, const CellBuffers& cells,
                         Footprint footprint, bool blended, const CellAppearance& appearance);
    bool triangles_are_small(std::span<const View> views, const Placement& placement) const;
    void draw_mesh(std::span<const View> views, const Placement& placement,
                   const CellBuffers& cells, const Layer& layer, const CellAppearance& appearance,
                   const FrameBlock& frame);
    void draw_footprints(std::size_t cells, int views, Footprint footprint, Form form);
    float gaussian_falloff() const;

    const Gl* gl_;
    FootprintShapes shapes_;
    bool two_views_at_once_;
    /// On software GL what is seen, nearest first: it saves far more than finding it takes. A GPU
    /// draws all quads in any order in less.
    bool seen_only_;
    bool all_cells_ = false; ///< nearest first nevertheless
    float largest_point_;    ///< pixels; 0: no points
    FootprintPrograms quad_programs_, gaussian_programs_;
    MeshPass mesh_;
    SurfacePass surface_;
    QuadIndices quads_;
    OrderCache orders_;
    SeenCells seen_;
    SeenSplats seen_splats_;
    Buffer seen_slots_;
    Texture seen_texture_;
    Buffer frame_;
};

} // namespace isochron::render
