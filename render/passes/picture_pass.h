// Draws a picture on a rectangle in space, such as a wall.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/shader.h"
#include "render/gl/view.h"

#include <glm/vec3.hpp>

#include <array>

namespace isochron::render {

class PicturePass {
  public:
    /// @throws Error when a shader does not compile
    explicit PicturePass(const Gl& gl);

    /// Draws into the view's viewport of the bound framebuffer; tests depth, and writes it if
    /// `opacity` is 1. Leaves depth test and depth writes on, blending and culling off.
    /// @param corners in the room: lower left, upper left, upper right, lower right
    /// @param texture 2D, with colors for the display; its first row is the bottom one
    /// @param opacity 0 to 1
    void draw(const View& view, const std::array<glm::vec3, 4>& corners, GLuint texture,
              float opacity) const;

  private:
    LazyProgram program_;
    VertexArray no_attributes_;
};

} // namespace isochron::render
