// Where the vertices of a rectilinear grid lie along its axes, for shaders.
#pragma once

#include "index/volume/grid.h"
#include "render/gl/gl_objects.h"

#include <glm/vec3.hpp>

#include <optional>

namespace isochron::render {

/// What shaders get in front of them that draw or shade a grid: cell_place.glsl asks for it.
const char* prelude_for(const index::Grid& grid);

/// The table of cell_place.glsl on the GPU; a regular grid has none.
class AxisTable {
  public:
    AxisTable(const Gl& gl, const index::Grid& grid);

    bool uneven() const { return texture_.has_value(); }
    /// Binds the table, if there is one, where cell_place.glsl expects it.
    void bind() const;
    /// The largest sides that a cell has, in even coordinates; 1 on a regular grid.
    const glm::vec3& largest() const { return largest_; }
    /// The least side of any cell, at most 1: slopes may be so much steeper than differences.
    float smallest() const { return smallest_; }

  private:
    const Gl* gl_;
    glm::vec3 largest_{1.0f};
    float smallest_ = 1.0f;
    std::optional<Buffer> buffer_;
    std::optional<Texture> texture_;
};

} // namespace isochron::render
