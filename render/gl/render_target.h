// An offscreen target with color and depth, which passes draw into and captures read.
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

/// Color SRGB8_ALPHA8 and depth 32F. It stores display values. `bind` and `clear` enable
/// GL_FRAMEBUFFER_SRGB, with which the GL converts: shaders write and read linear light, and
/// blending and resolving work in linear light. Passes that write display values disable it
/// meanwhile.
class RenderTarget {
  public:
    /// @param size pixels, each at least 1
    /// @param samples of each pixel, 1 to `max_samples`
    /// @throws Error when the driver cannot make it
    RenderTarget(const Gl& gl, glm::ivec2 size, int samples = 1);

    glm::ivec2 size() const { return size_; }
    int samples() const { return samples_; }
    /// With several samples these hold the last resolved picture.
    GLuint framebuffer() const { return framebuffer_.name(); }
    GLuint color_texture() const { return color_.name(); }
    GLuint depth_texture() const { return depth_.name(); } ///< with one sample alone
    /// The framebuffer to draw into: color and depth of every sample.
    GLuint drawn_framebuffer() const { return many_ ? many_->framebuffer.name() : framebuffer(); }

    /// Does nothing if the size is the same; else the contents become undefined.
    void resize(glm::ivec2 size);

    /// Draws go here from now on, with the viewport set to the whole target.
    void bind() const;

    /// Fills color, and sets depth to 1, whatever masks and scissor are set.
    /// @param color sRGB, with its opacity
    void clear(glm::vec4 color) const;

    /// Averages the samples; does nothing with one sample.
    void resolve() const;

    /// Waits for the GPU and reads the display values of the last resolved picture.
    Image read() const { return read({0, 0}, size_); }
    /// Reads a part of it. @param corner lower left of the part, pixels
    Image read(glm::ivec2 corner, glm::ivec2 size) const;

  private:
    /// The target with several samples per pixel.
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
