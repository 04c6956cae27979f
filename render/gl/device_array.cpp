// A growing array on the GPU.
#include "render/gl/device_array.h"

#include "render/gl/buffer_texture.h"
#include "render/gl/gl_memory.h"
#include "render/gl/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace isochron::render {

DeviceArray::DeviceArray(const Gl& gl, const char* what, GLenum format, std::size_t texel_bytes,
                         std::size_t texels, Storage storage)
    : gl_(&gl), what_(what), format_(format), texel_bytes_(texel_bytes), texels_(texels),
      buffer_(gl), texture_(gl, GL_TEXTURE_BUFFER) {
    const Limits limits(gl);
    limit_ = limits.buffer_texels / texels_;
    if (storage == Storage::whole)
        limit_ = std::min(limit_, limits.storage_block_bytes / element_bytes());
    reserve(1, Contents::dropped); // so that the texture always has memory
}

void DeviceArray::reserve(std::size_t elements, Contents contents) {
    if (elements <= capacity_)
        return;
    if (elements > limit_)
        throw Error("{} {}: this GL holds at most {}", elements, what_, limit_);
    // Grow by at least half, so that slowly growing sets rarely need a new buffer.
    const std::size_t capacity = std::min(std::max(elements, capacity_ + capacity_ / 2), limit_);
    Buffer larger(*gl_);
    gl_->NamedBufferData(larger.name(),
                         static_cast<GLsizeiptr>(
                             texel_storage(capacity * element_bytes(), limit_ * element_bytes())),
                         nullptr, GL_DYNAMIC_COPY);
    expect_memory(*gl_, fmt::format("{} {}", elements, what_));
    if (contents == Contents::kept)
        gl_->CopyNamedBufferSubData(buffer_.name(), larger.name(), 0, 0,
                                    static_cast<GLsizeiptr>(capacity_ * element_bytes()));
    gl_->TextureBuffer(texture_.name(), format_, larger.name());
    buffer_ = std::move(larger);
    capacity_ = capacity;
}

} // namespace isochron::render
