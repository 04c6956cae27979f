// Draws lit triangles: simple models of things in the room.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/shader.h"
#include "render/gl/texel_buffer.h"
#include "render/gl/view.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <span>
#include <vector>

namespace isochron::render {

struct Triangle {
    std::array<glm::vec3, 3> corners; ///< counter-clockwise from outside
    glm::vec3 color;                  ///< sRGB, 0 to 1
};

/// An ellipsoid of flat facets around a center.
std::vector<Triangle> ellipsoid(glm::vec3 center, glm::vec3 radii, glm::vec3 color);
/// A box between two corners, `low` below `high` on every axis.
std::vector<Triangle> solid_box(glm::vec3 low, glm::vec3 high, glm::vec3 color);
/// A pyramid without its base. @param base corners, counter-clockwise as seen from outside
std::vector<Triangle> pyramid(const std::array<glm::vec3, 4>& base, glm::vec3 tip, glm::vec3 color);

class SolidPass {
  public:
    /// @throws Error when a shader does not compile
    explicit SolidPass(const Gl& gl);

    /// Draws into the view's viewport of the bound framebuffer, opaque; facets are brighter the
    /// more they face the eye. Tests and writes depth. Leaves depth test and depth writes on,
    /// blending and culling off.
    void draw(const View& view, const glm::mat4& room_from_model,
              std::span<const Triangle> triangles);

  private:
    LazyProgram program_;
    VertexArray no_attributes_;
    TexelBuffer corners_;
};

} // namespace isochron::render
