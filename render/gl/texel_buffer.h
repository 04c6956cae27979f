// A buffer texture with the data of one draw: a few numbers for each line, character or triangle.
#pragma once

#include "render/gl/buffer_texture.h"

#include <cstddef>
#include <span>

namespace isochron::render {

/// Texels of four floats, which are replaced for every draw.
class TexelBuffer {
  public:
    /// @param what it holds, for the error: "lines"
    /// @param texels number of texels of each element
    TexelBuffer(const Gl& gl, const char* what, std::size_t texels);

    /// Replaces the contents. @throws Error when they are too large for the driver's buffer
    /// textures
    void set(std::span<const std::byte> bytes);
    GLuint texture() const { return texels_.texture(); }

  private:
    const char* what_;
    std::size_t element_bytes_, limit_;
    BufferTexture texels_;
};

} // namespace isochron::render
