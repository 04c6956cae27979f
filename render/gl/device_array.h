// A growing array on the GPU, as a buffer and as a buffer texture.
#pragma once

#include "render/gl/gl_objects.h"

#include <cstddef>

namespace isochron::render {

/// Elements of one texel format.
class DeviceArray {
  public:
    /// Whether shaders also write to all of it as one storage block, or only read it as a texture.
    enum class Storage : bool { none, whole };

    /// @param what it holds, for the error: "cells"
    /// @param texels number of texels in an element
    DeviceArray(const Gl& gl, const char* what, GLenum format, std::size_t texel_bytes,
                std::size_t texels, Storage storage);

    enum class Contents : bool { dropped, kept };
    /// Makes room for at least `elements`. To keep the contents the GPU copies them; if they are
    /// dropped, the GPU may still draw from the old memory while the new one is written.
    /// @throws Error when `elements` is more than `limit()`; OutOfMemory, with all as it was, when
    /// the GL has no memory for them
    void reserve(std::size_t elements, Contents contents);

    std::size_t capacity() const { return capacity_; }
    /// Most elements that the driver's buffer textures and storage blocks can hold.
    std::size_t limit() const { return limit_; }
    std::size_t element_bytes() const { return texels_ * texel_bytes_; }
    GLuint buffer() const { return buffer_.name(); }
    GLuint texture() const { return texture_.name(); }

  private:
    const Gl* gl_;
    const char* what_;
    GLenum format_;
    std::size_t texel_bytes_, texels_;
    std::size_t limit_ = 0, capacity_ = 0;
    Buffer buffer_;
    Texture texture_;
};

} // namespace isochron::render
