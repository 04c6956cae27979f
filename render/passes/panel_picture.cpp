// Allocates a panel's picture and draws into it.
#include "render/passes/panel_picture.h"

#include "render/gl/limits.h"

#include <algorithm>
#include <array>
#include <bit>

namespace isochron::render {

PanelPicture::PanelPicture(const Gl& gl, glm::ivec2 size)
    : gl_(&gl), size_(size), color_(gl, GL_TEXTURE_2D), framebuffer_(gl) {
    expect_target(Limits(gl), "panel's picture", size);
    const auto levels = std::bit_width(static_cast<unsigned>(std::max(size.x, size.y)));
    gl.TextureStorage2D(color_.name(), static_cast<GLsizei>(levels), GL_SRGB8_ALPHA8, size.x,
                        size.y);
    gl.TextureParameteri(color_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl.TextureParameteri(color_.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.TextureParameteri(color_.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TextureParameteri(color_.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl.NamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, color_.name(), 0);
}

void PanelPicture::begin() const {
    constexpr std::array<GLfloat, 4> kNothing{};
    gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    gl_->Enable(GL_FRAMEBUFFER_SRGB);
    gl_->Disable(GL_SCISSOR_TEST);
    gl_->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl_->ClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, 0, kNothing.data());
}

void PanelPicture::end() const {
    gl_->GenerateTextureMipmap(color_.name());
}

} // namespace isochron::render
