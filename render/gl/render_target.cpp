// Allocates, clears and reads an offscreen target.
#include "render/gl/render_target.h"

#include "render/gl/driver.h"
#include "render/gl/gl_memory.h"
#include "render/gl/limits.h"
#include "render/gl/srgb.h"

#include <fmt/format.h>

#include <algorithm>

namespace isochron::render {

RenderTarget::RenderTarget(const Gl& gl, glm::ivec2 size, int samples)
    : gl_(&gl), size_(size), samples_(samples), color_(gl, GL_TEXTURE_2D),
      depth_(gl, GL_TEXTURE_2D), framebuffer_(gl) {
    if (samples < 1 || samples > max_samples(gl))
        throw Error("render target: {} samples for each pixel, this GL has 1 to {}", samples,
                    max_samples(gl));
    allocate();
}

void RenderTarget::resize(glm::ivec2 size) {
    if (size == size_)
        return;
    size_ = size;
    // Immutable storage cannot change its size, so make new textures.
    color_ = Texture(*gl_, GL_TEXTURE_2D);
    depth_ = Texture(*gl_, GL_TEXTURE_2D);
    allocate();
}

void RenderTarget::allocate() {
    expect_target(Limits(*gl_), "render target", size_);
    gl_->TextureStorage2D(color_.name(), 1, GL_SRGB8_ALPHA8, size_.x, size_.y);
    gl_->TextureParameteri(color_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl_->TextureParameteri(color_.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl_->TextureParameteri(color_.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl_->NamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, color_.name(), 0);
    if (samples_ > 1)
        return allocate_samples();
    gl_->TextureStorage2D(depth_.name(), 1, GL_DEPTH_COMPONENT32F, size_.x, size_.y);
    // Depths are fetched one at a time; not every device can filter them.
    gl_->TextureParameteri(depth_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_->TextureParameteri(depth_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl_->NamedFramebufferTexture(framebuffer_.name(), GL_DEPTH_ATTACHMENT, depth_.name(), 0);
    expect_complete(framebuffer_.name());
}

void RenderTarget::allocate_samples() {
    many_.emplace(*gl_);
    const GLuint framebuffer = many_->framebuffer.name();
    gl_->NamedRenderbufferStorageMultisample(many_->color.name(), samples_, GL_SRGB8_ALPHA8,
                                             size_.x, size_.y);
    gl_->NamedRenderbufferStorageMultisample(many_->depth.name(), samples_, GL_DEPTH_COMPONENT32F,
                                             size_.x, size_.y);
    gl_->NamedFramebufferRenderbuffer(framebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                      many_->color.name());
    gl_->NamedFramebufferRenderbuffer(framebuffer, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                      many_->depth.name());
    expect_complete(framebuffer);
}

void RenderTarget::expect_complete(GLuint framebuffer) const {
    expect_memory(
        *gl_, fmt::format("render target: {}x{} pixels of {} samples", size_.x, size_.y, samples_));
    const GLenum status = gl_->CheckNamedFramebufferStatus(framebuffer, GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw Error("render target: {}x{} pixels of {} samples, framebuffer status {:#x}, expected "
                    "complete",
                    size_.x, size_.y, samples_, status);
}

void RenderTarget::bind() const {
    gl_->BindFramebuffer(GL_FRAMEBUFFER, drawn_framebuffer());
    gl_->Enable(GL_FRAMEBUFFER_SRGB);
    gl_->Viewport(0, 0, size_.x, size_.y);
}

void RenderTarget::clear(glm::vec4 color) const {
    const GLfloat far = 1.0f;
    const glm::vec4 light(linear_from_srgb(glm::vec3(color)), color.w);
    gl_->Enable(GL_FRAMEBUFFER_SRGB);
    gl_->Disable(GL_SCISSOR_TEST);
    gl_->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl_->DepthMask(GL_TRUE);
    gl_->ClearNamedFramebufferfv(drawn_framebuffer(), GL_COLOR, 0, &light.x);
    gl_->ClearNamedFramebufferfv(drawn_framebuffer(), GL_DEPTH, 0, &far);
}

void RenderTarget::resolve() const {
    if (!many_)
        return;
    gl_->Enable(GL_FRAMEBUFFER_SRGB);
    gl_->Disable(GL_SCISSOR_TEST);
    gl_->BlitNamedFramebuffer(many_->framebuffer.name(), framebuffer_.name(), 0, 0, size_.x,
                              size_.y, 0, 0, size_.x, size_.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

Image RenderTarget::read(glm::ivec2 corner, glm::ivec2 size) const {
    Image image{size.x, size.y, std::vector<std::uint8_t>(std::size_t{4} * size.x * size.y)};
    gl_->BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    gl_->PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_->GetTextureSubImage(color_.name(), 0, corner.x, corner.y, 0, size.x, size.y, 1, GL_RGBA,
                            GL_UNSIGNED_BYTE, static_cast<GLsizei>(image.rgba.size()),
                            image.rgba.data());
    // GL's first row is the bottom one.
    const std::size_t row = std::size_t{4} * size.x;
    for (int y = 0; y < size.y / 2; ++y)
        std::swap_ranges(image.rgba.begin() + y * row, image.rgba.begin() + (y + 1) * row,
                         image.rgba.begin() + (size.y - 1 - y) * row);
    return image;
}

} // namespace isochron::render
