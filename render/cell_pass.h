// Draws a set of cells as fast quads or as Gaussian splats (ShellSplatting).
#pragma once

#include "render/cell_buffers.h"
#include "render/order_cache.h"
#include "render/placement.h"
#include "render/quad_indices.h"
#include "render/view.h"

#include <cstdint>

namespace isochron::render {

/// What a cell looks like on the screen; both share the cells and their geometry.
enum class Footprint : std::uint8_t {
    quad,    ///< flat and opaque, in any order: for motion
    gaussian ///< blended back to front: for a settled view
};

/// Sizes in voxels: lengths in vertex index coordinates, so anisotropic spacing stretches them.
/// Defaults from the authors' own later code.
struct FootprintShapes {
    float quad_diameter = 1.6f;
    float gaussian_diameter = 4.0f; ///< where the Gaussian is cut off
    float gaussian_sigma = 0.7f;
};

struct CellAppearance {
    glm::vec3 color{0.97f, 0.88f, 0.70f}; ///< as a display shows it (sRGB), 0 to 1
    float opacity = 1.0f;                 ///< of the middle of a Gaussian splat, 0 to 1
    float ambient = 0.05f;
    float diffuse = 0.95f;   ///< head light, both sides
    float specular = 0.22f;  ///< added in white
    float shininess = 24.0f; ///< exponent of the highlight
    /// How much darker the far end of the volume is than its near end, 0 to 1.
    float depth_cue = 0.45f;
};

class CellPass {
  public:
    /// @throws Error when a shader does not compile
    explicit CellPass(const Gl& gl, const FootprintShapes& shapes = {});

    /// Draws the shown set into the bound framebuffer and current viewport of `view.size`; nothing
    /// when no set is shown. Quads test and write depth; splats test it only, and blend over what
    /// is there with pre-multiplied alpha. Leaves depth test and depth writes on, blending and
    /// culling off.
    void draw(const View& view, const Placement& placement, const CellBuffers& cells,
              Footprint footprint, const CellAppearance& appearance = {});

    const OrderCache& orders() const { return orders_; }

  private:
    const Gl* gl_;
    FootprintShapes shapes_;
    Program quad_program_, gaussian_program_;
    QuadIndices quads_;
    OrderCache orders_;
    Buffer frame_;
};

} // namespace isochron::render
