// The limit of this GL: plain quads at the footprints, without any computation.
#pragma once

#include "render/cells/placement.h"
#include "render/cells/slot_assignment.h"
#include "render/gl/gl_objects.h"
#include "render/gl/view.h"

#include <span>
#include <vector>

namespace isochron::bench {

/// Upright rectangles around the ellipses of the cells' spheres, in pixels from the middle of the
/// viewport and clip depth: 4 corners per cell, as (x, y) clip coordinates after the division, z.
/// @param order back to front; empty: as they are
std::vector<glm::vec3> projected_corners(const render::View& view,
                                         const render::Placement& placement, float radius,
                                         std::span<const render::CellPlace> places,
                                         std::span<const std::uint32_t> order);

class BareQuads {
  public:
    explicit BareQuads(const render::Gl& gl);

    /// Sets the corners of one view, before the draws.
    void set(std::size_t view, const std::vector<glm::vec3>& corners);

    /// One flat color, no texture; opaque quads test and write depth, others blend.
    void draw(std::span<const render::View> views, bool blended) const;

  private:
    struct OfView {
        explicit OfView(const render::Gl& gl) : corners(gl), array(gl) {}
        render::Buffer corners;
        render::VertexArray array;
        GLsizei indices = 0;
    };
    const render::Gl* gl_;
    render::Program program_;
    render::Buffer indices_;
    std::vector<OfView> views_;
};

} // namespace isochron::bench
