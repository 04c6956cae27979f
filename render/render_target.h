// An offscreen picture with depth that passes draw into and captures read from.
#pragma once

#include "render/gl_objects.h"
#include "render/image.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace isochron::render {

/// Colour RGBA8 and depth 32F. The colours are meant for the display as they are (sRGB-encoded).
class RenderTarget {
  public:
    /// @param size pixels, each at least 1. @throws Error when the driver cannot make it
    RenderTarget(const Gl& gl, glm::ivec2 size);

    glm::ivec2 size() const { return size_; }
    GLuint framebuffer() const { return framebuffer_.name(); }
    GLuint color_texture() const { return color_.name(); }

    /// Does nothing when the size is the same already; otherwise the contents become undefined.
    void resize(glm::ivec2 size);

    /// Draws go here from now on, with the viewport set to the whole target.
    void bind() const;

    /// Fills colour, and depth with 1, whatever masks and scissor are set.
    void clear(glm::vec4 color) const;

    /// Waits for the GPU and reads the colours.
    Image read() const;

  private:
    void allocate();

    const Gl* gl_;
    glm::ivec2 size_;
    Texture color_, depth_;
    Framebuffer framebuffer_;
};

} // namespace isochron::render
