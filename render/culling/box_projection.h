// Where boxes are in a view: bounds for occlusion culling.
#pragma once

#include "render/cells/placement.h"
#include "render/gl/view.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <optional>

namespace isochron::render {

/// Contains all that can be seen of a box.
struct BoxBounds {
    glm::vec2 low, high; ///< corners of a rectangle [pixel of the viewport]
    float nearest;       ///< window depth
};

/// Bounds of upright boxes in even coordinates (see `index::Grid::physical_from_index`): a little
/// larger than the boxes, to be safe from rounding.
class BoxProjection {
  public:
    BoxProjection(const View& view, const Placement& placement);

    /// @param half half the box's sides
    /// @return nothing for a box that is wholly behind the eye or beside the view; everything for
    /// one that comes near to the eye's plane
    std::optional<BoxBounds> bounds(const glm::vec3& middle, const glm::vec3& half) const;

  private:
    glm::vec2 size_, center_; ///< size and center of the viewport [pixel]
    glm::vec4 x_, y_, w_;     ///< rows from even coordinates to clip space, x and y in pixels
    /// Clip depth is `slope_` + (this row) / w. In perspective this row is constant, so that bounding
    /// both terms bounds the depth.
    glm::vec4 rest_;
    float slope_;
};

} // namespace isochron::render
