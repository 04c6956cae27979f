// An offscreen picture with depth that passes draw into and captures read from.
//
//     RenderTarget target(gl, {1024, 1024}, 4);
//     target.clear({0, 0, 0, 1});
//     target.bind();
//     pass.draw(view);
//     target.resolve();
//     write(target.read());
#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/image.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <optional>

namespace isochron::render {

/// Color SRGB8_ALPHA8 and depth 32F. What is stored are display values; GL_FRAMEBUFFER_SRGB, on
/// from `bind` and `clear` on, has the GL convert: shaders write light and read light, and blending
/// and resolving average light. Passes that write display values switch it off meanwhile.
class RenderTarget {
  public:
    /// @param size pixels, each at least 1
    /// @param samples of each pixel, 1 to `max_samples`
    /// @throws Error when the driver cannot make it
    RenderTarget(const Gl& gl, glm::ivec2 size, int samples = 1);

    glm::ivec2 size() const { return size_; }
    int samples() const { return samples_; }
    /// With several samples these hold what was resolved last.
    GLuint framebuffer() const { return framebuffer_.name(); }
    GLuint color_texture() const { return color_.name(); }
    /// What is drawn into: color and depth of every sample.
    GLuint drawn_framebuffer() const { return many_ ? many_->framebuffer.name() : framebuffer(); }

    /// Does nothing when the size is the same already; otherwise the contents become undefined.
    void resize(glm::ivec2 size);

    /// Draws go here from now on, with the viewport set to the whole target.
    void bind() const;

    /// Fills color, and depth with 1, whatever masks and scissor are set.
    /// @param color sRGB, with its opacity
    void clear(glm::vec4 color) const;

    /// Averages the samples; with one sample there is nothing to do.
    void resolve() const;

    /// Waits for the GPU and reads the display values that were resolved last.
    Image read() const { return read({0, 0}, size_); }
    /// A part of them. @param corner its lower left, pixels
    Image read(glm::ivec2 corner, glm::ivec2 size) const;

  private:
    /// What is drawn into where pixels have several samples.
    struct Samples {
        explicit Samples(const Gl& gl) : color(gl), depth(gl), framebuffer(gl) {}
        Renderbuffer color, depth;
        Framebuffer framebuffer;
    };
    void allocate();
    void allocate_samples();
    void expect_complete(GLuint framebuffer) const;

    const Gl* gl_;
    glm::ivec2 size_;
    int samples_;
    Texture color_, depth_;
    Framebuffer framebuffer_;
    std::optional<Samples> many_;
};

} // namespace isochron::render
