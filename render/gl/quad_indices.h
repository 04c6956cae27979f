// Indices for drawing many quads, shared by passes whose vertex shader places vertex 4 q + corner.
#pragma once

#include "render/gl/gl_objects.h"

#include <cstddef>

namespace isochron::render {

/// No vertices are stored: the shader finds its data by gl_VertexID. Quads are drawn as plain
/// vertices, because software GL processes many vertices at a time, but one instance at a time.
class QuadIndices {
  public:
    explicit QuadIndices(const Gl& gl);

    /// Draws `quads` quads with the current program; corners go counter-clockwise from the lower
    /// left: (-1,-1), (1,-1), (1,1), (-1,1).
    /// @param instances of each quad; within an instance the quads keep their order
    /// @param begin number of the first quad
    void draw(std::size_t quads, int instances = 1, std::size_t begin = 0) const;

    /// Draws with shaders that place one point per vertex.
    void draw_points(std::size_t points, int instances = 1) const;

  private:
    const Gl* gl_;
    VertexArray vertex_array_;
    Buffer indices_;
};

} // namespace isochron::render
