// Where the vertices of a rectilinear grid lie along its axes, for shaders.
#pragma once

#include "index/volume/grid.h"
#include "render/gl/buffer_texture.h"

#include <glm/vec3.hpp>

#include <optional>

namespace isochron::render {

/// The lines to put in front of a shader that draws or shades the grid; cell_place.glsl needs them.
const char* prelude_for(const index::Grid& grid);

/// The table of cell_place.glsl on the GPU; a regular grid has none.
class AxisTable {
  public:
    AxisTable(const Gl& gl, const index::Grid& grid);

    bool uneven() const { return texels_.has_value(); }
    /// Binds the table, if there is one, where cell_place.glsl expects it.
    void bind() const;
    /// The largest sides that a cell has, in even coordinates; 1 on a regular grid.
    const glm::vec3& largest() const { return largest_; }
    /// The smallest side of any cell, at most 1. Slopes are up to 1/smallest times as steep as the
    /// differences of values.
    float smallest() const { return smallest_; }

  private:
    const Gl* gl_;
    glm::vec3 largest_{1.0f};
    float smallest_ = 1.0f;
    std::optional<BufferTexture> texels_;
};

} // namespace isochron::render
