// Writes the texels of a draw.
#include "render/gl/texel_buffer.h"

#include "render/gl/limits.h"

namespace isochron::render {

TexelBuffer::TexelBuffer(const Gl& gl, const char* what, std::size_t texels)
    : what_(what), element_bytes_(texels * 4 * sizeof(float)),
      limit_(Limits(gl).buffer_texels / texels), texels_(gl) {}

void TexelBuffer::set(std::span<const std::byte> bytes) {
    const std::size_t elements = bytes.size() / element_bytes_;
    if (elements > limit_)
        throw Error("{} {} in one draw: this GL holds at most {}", elements, what_, limit_);
    texels_.set(GL_RGBA32F, 4 * sizeof(float), bytes);
}

} // namespace isochron::render
