// Draws a set of cells as fast quads, as Gaussian splats (ShellSplatting) or as the exact surface.
#pragma once

#include "index/volume/query.h"
#include "render/cells/cell_buffers.h"
#include "render/cells/cell_shape.h"
#include "render/cells/order_cache.h"
#include "render/cells/placement.h"
#include "render/cells/quad_culling.h"
#include "render/cells/splat_culling.h"
#include "render/cells/splat_opacity.h"
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

/// What a cell looks like on the screen, from the fastest to the best; all share the cells.
enum class Footprint : std::uint8_t {
    quad,     ///< flat and opaque, in any order: for motion
    gaussian, ///< blended back to front: for a settled view
    surface   ///< the exact trilinear isosurface, crisp at any distance: for a settled view
};
inline constexpr std::size_t kFootprints = 3;

/// The best footprint that `CellPass` draws.
inline constexpr Footprint kBestFootprint = Footprint::surface;

/// `quad`, `gaussian`, `surface`: as configuration files and reports call them.
const char* name_of(Footprint footprint);

/// Sizes in voxels: lengths in vertex index coordinates, so anisotropic spacing stretches them.
/// Those of the Gaussian are of the authors' own later code, which had quads of 1.6 voxels. But
/// discs of sqrt(2) cover the middles of a layer of cells seen face-on without a gap, and the other
/// views of a surface crowd its cells: nothing shows through that does not through 1.6, and a fifth
/// fewer pixels are drawn.
struct FootprintShapes {
    CellShape shape = CellShape::plane;
    // Of spheres:
    float quad_diameter = 1.41421356f;
    float gaussian_diameter = 4.0f; ///< where the Gaussian is cut off
    float gaussian_sigma = 0.7f;
    // Of ellipsoids on planes that pass near the middles of their cells:
    float plane_radius = 0.8f;
    float plane_gaussian_radius = 1.45f; ///< where the Gaussian is cut off
    float plane_sigma = 0.5075f;

    /// Half of the diameter with this footprint and shape.
    float radius_of(Footprint footprint) const;
    float sigma() const { return shape == CellShape::plane ? plane_sigma : gaussian_sigma; }
};

/// How one isosurface looks.
struct SurfaceAppearance {
    glm::vec3 color{0.97f, 0.88f, 0.70f}; ///< as a display shows it (sRGB), 0 to 1
    float opacity = 1.0f;                 ///< of the surface seen face-on, 0 to 1
};

/// Colors by value: cells carry the value's place in its whole range (`index::CellPoint`).
struct ValueColors {
    GLuint map = 0;                       ///< GL_TEXTURE_1D in linear light, from low to high
    float low = 0.0f, high = 1.0f;        ///< ends of the map, as fractions of the whole range
    glm::vec3 no_value{0.5f, 0.5f, 0.5f}; ///< sRGB, where there is none
};

/// What comes near to a viewer is left out little by little, so that nobody stands in a wall of it:
/// splats and blended surfaces by opacity, quads and opaque surfaces by ever fewer cells and grains
/// of them, chosen in the volume. Distances are from the middle between the eyes, so that both see
/// the same.
struct NearFade {
    float gone = 0.15f,
          whole = 0.35f; ///< [m] nearer than the one nothing is drawn, beyond the other all
    glm::vec3 between_eyes{0.0f}; ///< room
};

struct CellAppearance {
    std::array<SurfaceAppearance, index::kMostSurfaces> surfaces;
    std::optional<ValueColors> values; ///< instead of the surfaces' colors

    float ambient = 0.15f;
    float head_light = 0.50f;                   ///< from the eye
    float key_light = 0.50f;                    ///< from a direction that stands still in the room
    glm::vec3 key_direction{-0.5f, 0.8f, 0.6f}; ///< towards the key light, room frame, any length
    float ground = 0.5f;       ///< ambient light from below, as a share of that from above
    float reflectance = 0.04f; ///< mirrored at normal incidence: 0.04 is that of most non-metals
    float shininess = 40.0f;   ///< exponent of the highlight
    float outline = 0.35f;     ///< how much darker the surface is where it turns away, 0 to 1
    /// How much darker the far end of the volume is than its near end, 0 to 1.
    float depth_cue = 0.45f;
    std::optional<NearFade> near_fade;
    /// A plane in the room, normal and offset: what lies above it is cut away, cells whole with
    /// quads and splats, exactly with surfaces.
    std::optional<glm::vec4> cut;
    /// Splats blend as light does. Without it they blend in display values, which on software GL
    /// takes two thirds of the time. Opaque quads look the same either way.
    bool linear_light = true;
};

class CellPass {
  public:
    /// @throws Error when a shader does not compile
    explicit CellPass(const Gl& gl, const FootprintShapes& shapes = {});

    /// Draws the cells into the views' viewports of the bound framebuffer, two views in one pass
    /// where the driver can; nothing where there are none. Quads and opaque surfaces test and write
    /// depth; splats and surfaces of less opacity test it only, and blend over what is there with
    /// pre-multiplied alpha. Surfaces are drawn from the corners that the cells have computed.
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
