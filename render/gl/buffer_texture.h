// A buffer that shaders read as a texture.
#pragma once

#include "render/gl/gl_objects.h"

#include <cstddef>
#include <span>

namespace isochron::render {

/// How large to make a buffer texture that holds so many bytes: at least that, and of a size that
/// needs no further shader of Mesa's llvmpipe. It compiles a shader once more, which takes up to
/// half a second in the middle of a session, for a texture whose size is a power of two, or whose
/// size in bytes has none of bits 8 to 15 (there it reads the last level of other textures).
/// @param most bytes that the GL can hold: no more than these, if `bytes` is not
std::size_t texel_storage(std::size_t bytes, std::size_t most);

/// Owns both; without contents at first.
class BufferTexture {
  public:
    explicit BufferTexture(const Gl& gl);

    /// Replaces the contents, in fresh storage: the GPU may still read what they were.
    /// @param format of a texel, as GL_R32UI, whose size is `texel_bytes`
    void set(GLenum format, std::size_t texel_bytes, std::span<const std::byte> bytes);

    GLuint buffer() const { return buffer_.name(); }
    GLuint texture() const { return texture_.name(); }

  private:
    const Gl* gl_;
    std::size_t limit_; ///< texels
    Buffer buffer_;
    Texture texture_;
};

} // namespace isochron::render
