// What one draw reads from a buffer texture: a few numbers for each line, character or triangle.
#pragma once

#include "render/gl/gl_objects.h"

#include <cstddef>
#include <span>

namespace isochron::render {

/// Texels of four floats, all written anew for every draw.
class TexelBuffer {
  public:
    /// @param what it holds, for the error: "lines"
    /// @param texels of each of these
    TexelBuffer(const Gl& gl, const char* what, std::size_t texels);

    /// @throws Error where they are more than the driver's buffer textures hold
    void set(std::span<const std::byte> bytes);
    GLuint texture() const { return texture_.name(); }

  private:
    const Gl* gl_;
    const char* what_;
    std::size_t element_bytes_, limit_;
    Buffer buffer_;
    Texture texture_;
};

} // namespace isochron::render
