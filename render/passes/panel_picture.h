// The picture of a panel in the room: drawn when it changes, seen from any distance.
//
//     PanelPicture picture(gl, {800, 1000});
//     picture.begin();   // clear and bound
//     draw_triangles();  // blended as `BlendFuncSeparate(SRC_ALPHA, .., ONE, ..)` does
//     picture.end();     // its smaller copies are made
#pragma once

#include "render/gl/gl_objects.h"

#include <glm/vec2.hpp>

namespace isochron::render {

/// Linear light with pre-multiplied opacity, stored as SRGB8_ALPHA8, with all mip levels: letters
/// stay legible and do not flicker, near and far.
class PanelPicture {
  public:
    /// @param size pixels
    PanelPicture(const Gl& gl, glm::ivec2 size);

    void begin() const;
    void end() const;
    glm::ivec2 size() const { return size_; }
    GLuint texture() const { return color_.name(); } ///< its first row is the bottom one

  private:
    const Gl* gl_;
    glm::ivec2 size_;
    Texture color_;
    Framebuffer framebuffer_;
};

} // namespace isochron::render
