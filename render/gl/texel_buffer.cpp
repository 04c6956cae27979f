// Writes the texels of a draw.
#include "render/gl/texel_buffer.h"

#include "render/gl/limits.h"

#include <fmt/format.h>

namespace isochron::render {

TexelBuffer::TexelBuffer(const Gl& gl, const char* what, std::size_t texels)
    : gl_(&gl), what_(what), element_bytes_(texels * 4 * sizeof(float)),
      limit_(Limits(gl).buffer_texels / texels), buffer_(gl), texture_(gl, GL_TEXTURE_BUFFER) {}

void TexelBuffer::set(std::span<const std::byte> bytes) {
    const std::size_t elements = bytes.size() / element_bytes_;
    if (elements > limit_)
        throw Error(
            fmt::format("{} {} in one draw: this GL holds at most {}", elements, what_, limit_));
    gl_->NamedBufferData(buffer_.name(), static_cast<GLsizeiptr>(bytes.size()), bytes.data(),
                         GL_STREAM_DRAW);
    gl_->TextureBuffer(texture_.name(), GL_RGBA32F, buffer_.name());
}

} // namespace isochron::render
