// Draws a picture that was drawn for other eyes, moved by its depth to where these eyes see it.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/shader.h"
#include "render/gl/view.h"

#include <glm/mat4x4.hpp>

namespace isochron::render {

/// A view of a finished picture of cells.
struct PictureWithDepth {
    GLuint color = 0, depth = 0; ///< textures; depth 1: nothing was drawn
    View view;                   ///< the view that it was drawn for, and its place in the textures
    glm::mat4 room_from_box{1};  ///< the cells lay in the box of 0 to 1 along each axis
};

class ReprojectPass {
  public:
    /// @param gl outlives the pass @throws Error when a shader does not compile
    explicit ReprojectPass(const Gl& gl);

    /// Draws the cells of `picture` with depth into the view's viewport of the bound framebuffer, and
    /// nothing where the picture shows none. Leaves depth test and depth writes on, blending off,
    /// and the viewport and scissor of the view set.
    /// @param room_from_box where the box of its cells is now
    void draw(const View& view, const PictureWithDepth& picture,
              const glm::mat4& room_from_box) const;

  private:
    const Gl* gl_;
    LazyProgram program_;
    VertexArray no_attributes_;
};

} // namespace isochron::render
