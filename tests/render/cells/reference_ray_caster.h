// A slow and simple ray-caster for a trilinear field, in double.
#pragma once

#include "render/cells/placement.h"
#include "render/gl/view.h"
#include "tests/render/cells/vertex_field.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <vector>

namespace isochron::render {

struct RayHit {
    glm::dvec3 at{0.0};     ///< even coordinates
    double depth = 0.0;     ///< window depth, 0 to 1
    glm::ivec3 cell{0};     ///< that the ray was in
    glm::dvec3 normal{0.0}; ///< gradient interpolated between the cell's vertices, as VertexField's
};

/// Walks through every cell along a ray, active or not, and isolates roots by subdivision: the
/// Bernstein coefficients of a cubic that all have one sign leave no room for a root (variation
/// diminishing property; G. Farin, "Curves and Surfaces for CAGD", 1988).
class ReferenceRayCaster {
  public:
    ReferenceRayCaster(const VertexField& field, const View& view, const Placement& placement);

    /// @param pixel from the lower left corner of the viewport; centers are at +0.5
    /// @return where the ray from the near to the far plane changes sides, nearest first
    std::vector<RayHit> hits(glm::dvec2 pixel) const;
    std::optional<RayHit> first_hit(glm::dvec2 pixel) const;

    /// The point that window coordinates stand for, in even coordinates.
    glm::dvec3 point(glm::dvec2 pixel, double depth) const;

  private:
    void cast(glm::dvec2 pixel, bool first_only, std::vector<RayHit>& found) const;

    const VertexField* field_;
    glm::dvec2 size_;
    glm::dmat4 index_from_clip_, clip_from_index_;
};

} // namespace isochron::render
