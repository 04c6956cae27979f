// The field of a set's surroundings on the GPU.
#include "render/cells/surroundings.h"

#include <array>
#include <bit>

namespace isochron::render {
namespace {

/// Places in the texture along an axis; some places may stay unused. llvmpipe compiles shaders anew
/// for sizes that are powers of two, as for buffer textures (see texel_storage).
int along_texture(int places) {
    while (std::has_single_bit(static_cast<unsigned>(places)))
        ++places;
    return places;
}

Texture field_texture(const Gl& gl, const glm::ivec3& places) {
    const glm::ivec3 size(along_texture(places.x), along_texture(places.y),
                          along_texture(places.z));
    Texture texture(gl, GL_TEXTURE_3D);
    gl.TextureStorage3D(texture.name(), 1, GL_R8, size.x, size.y, size.z);
    gl.TextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        gl.TextureParameteri(texture.name(), axis, GL_CLAMP_TO_EDGE);
    return texture;
}

void fill(const Gl& gl, GLuint texture, const glm::ivec3& size, const void* bytes) {
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl.TextureSubImage3D(texture, 0, 0, 0, 0, size.x, size.y, size.z, GL_RED, GL_UNSIGNED_BYTE,
                         bytes);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

} // namespace

Surroundings::Surroundings(const Gl& gl) : gl_(&gl), held_(1) {
    texture_.emplace(field_texture(gl, held_));
    constexpr std::array<std::uint8_t, 1> kNothing{0};
    fill(gl, texture_->name(), held_, kNothing.data());
}

std::size_t Surroundings::show(const index::SurroundingField& field) {
    size_ = glm::ivec3(field.size[0], field.size[1], field.size[2]);
    if (field.shares.empty()) {
        size_ = glm::ivec3(0);
        return 0;
    }
    per_voxel_ = 1.0f / static_cast<float>(field.stride);
    const int surfaces = static_cast<int>(
        field.shares.size() / (std::size_t{field.size[0]} * field.size[1] * field.size[2]));
    const glm::ivec3 whole(size_.x, size_.y, size_.z * surfaces);
    if (whole != held_)
        texture_.emplace(field_texture(*gl_, whole));
    held_ = whole;
    fill(*gl_, texture_->name(), whole, field.shares.data());
    return field.shares.size();
}

} // namespace isochron::render
