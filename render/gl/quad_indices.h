// The indices of many quads, shared by passes whose vertex shader places vertex 4 q + corner.
#pragma once

#include "render/gl/gl_objects.h"

#include <cstddef>

namespace isochron::render {

/// No vertex is stored: the shader finds what it draws from gl_VertexID. A draw of plain vertices,
/// since software GL runs those many at a time and instances one by one.
class QuadIndices {
  public:
    explicit QuadIndices(const Gl& gl);

    /// Draws `quads` quads with the current program; corners go counter-clockwise from the lower
    /// left: (-1,-1), (1,-1), (1,1), (-1,1).
    /// @param instances of every quad; those of one instance keep their order
    void draw(std::size_t quads, int instances = 1) const;

    /// The same for shaders that place one point for each.
    void draw_points(std::size_t points, int instances = 1) const;

  private:
    const Gl* gl_;
    VertexArray vertex_array_;
    Buffer indices_;
};

} // namespace isochron::render
