// Sends what buffer textures show.
#include "render/gl/buffer_texture.h"

#include "render/gl/limits.h"

#include <algorithm>
#include <bit>

namespace isochron::render {

std::size_t texel_storage(std::size_t bytes, std::size_t most) {
    constexpr std::size_t kStep = 1 << 8, kBits = 0xff00;
    std::size_t storage = bytes;
    while (std::has_single_bit(storage) || (storage & kBits) == 0)
        storage += kStep;
    return std::max(bytes, std::min(storage, most));
}

BufferTexture::BufferTexture(const Gl& gl)
    : gl_(&gl), limit_(Limits(gl).buffer_texels), buffer_(gl), texture_(gl, GL_TEXTURE_BUFFER) {}

void BufferTexture::set(GLenum format, std::size_t texel_bytes, std::span<const std::byte> bytes) {
    const std::size_t storage = texel_storage(bytes.size(), limit_ * texel_bytes);
    gl_->NamedBufferData(buffer_.name(), static_cast<GLsizeiptr>(storage), nullptr, GL_STREAM_DRAW);
    gl_->NamedBufferSubData(buffer_.name(), 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
    gl_->TextureBuffer(texture_.name(), format, buffer_.name());
}

} // namespace isochron::render
