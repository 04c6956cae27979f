// Draws a view in few pixels and makes the picture as large as the view.
#include "render/passes/enlarge_pass.h"

#include "render/gl/gl_memory.h"
#include "render/gl/soft_edges.h"
#include "render/gl/viewport.h"
#include "render/passes/pixel_box.h"

#include <fmt/format.h>

#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include <cassert>

namespace isochron::render {

EnlargePass::Target::Target(const Gl& gl, glm::ivec2 pixels, bool linear_light)
    : size(pixels), linear(linear_light), color(gl, GL_TEXTURE_2D), depth(gl, GL_TEXTURE_2D),
      framebuffer(gl) {
    // Display values are kept as they are written: their conversion takes a processor's time.
    gl.TextureStorage2D(color.name(), 1, linear ? GL_SRGB8_ALPHA8 : GL_RGBA8, size.x, size.y);
    gl.TextureStorage2D(depth.name(), 1, GL_DEPTH_COMPONENT32F, size.x, size.y);
    for (const GLuint texture : {color.name(), depth.name()}) {
        const GLint filter = texture == color.name() ? GL_LINEAR : GL_NEAREST;
        gl.TextureParameteri(texture, GL_TEXTURE_MIN_FILTER, filter);
        gl.TextureParameteri(texture, GL_TEXTURE_MAG_FILTER, filter);
        gl.TextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        gl.TextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }
    gl.NamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, color.name(), 0);
    gl.NamedFramebufferTexture(framebuffer.name(), GL_DEPTH_ATTACHMENT, depth.name(), 0);
    const std::string what = fmt::format("few pixels of a view: {}x{}", size.x, size.y);
    expect_memory(gl, what);
    const GLenum status = gl.CheckNamedFramebufferStatus(framebuffer.name(), GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw Error("{}, framebuffer status {:#x}, expected complete", what, status);
}

EnlargePass::EnlargePass(const Gl& gl)
    : gl_(&gl), program_(gl, {shader_file("full_screen.vert"), shader_file("enlarge.frag")}),
      no_attributes_(gl) {}

void EnlargePass::begin(std::span<const View> views, float share, bool linear) {
    constexpr int kBetween = 2; // pixels between two views, so that neither shows in the other
    few_.assign(views.begin(), views.end());
    glm::ivec2 size(0);
    for (View& view : few_) {
        view.size = glm::max(glm::ivec2(glm::ceil(share * glm::vec2(view.size))), glm::ivec2(1));
        view.corner = {size.x, 0};
        size = {size.x + view.size.x + kBetween, glm::max(size.y, view.size.y)};
    }
    GLint bound = 0;
    gl_->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    bound_ = static_cast<GLuint>(bound);
    if (!target_ || target_->size != size || target_->linear != linear)
        target_.emplace(*gl_, size, linear);
    const glm::vec4 nothing(0.0f);
    const GLfloat far = 1.0f;
    const GLuint framebuffer = target_->framebuffer.name();
    gl_->Disable(GL_SCISSOR_TEST);
    gl_->DepthMask(GL_TRUE);
    gl_->ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, &nothing.x);
    gl_->ClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &far);
    gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl_->Enable(GL_SCISSOR_TEST);
    for (std::size_t i = 0; i < few_.size(); ++i)
        set_viewport(*gl_, few_[i], static_cast<GLuint>(i));
}

void EnlargePass::end(std::span<const View> views, const glm::mat4& room_from_box,
                      bool layers) const {
    assert(target_ && views.size() == few_.size());
    gl_->BindFramebuffer(GL_FRAMEBUFFER, bound_);
    if (!target_->linear) // display values, which the target must not convert
        gl_->Disable(GL_FRAMEBUFFER_SRGB);
    gl_->DepthFunc(GL_LESS);
    gl_->DepthMask(GL_TRUE);
    if (layers) {
        gl_->Disable(GL_DEPTH_TEST);
        blend_over(*gl_);
    } else {
        gl_->Enable(GL_DEPTH_TEST);
        gl_->Disable(GL_BLEND);
    }
    gl_->BindTextureUnit(0, target_->color.name());
    gl_->BindTextureUnit(1, target_->depth.name());
    const GLuint program = program_.name();
    gl_->UseProgram(program);
    gl_->ProgramUniform1i(program, 1, layers ? 1 : 0);
    gl_->BindVertexArray(no_attributes_.name());
    const glm::vec2 whole(target_->size);
    for (std::size_t i = 0; i < views.size(); ++i) {
        const glm::vec2 scale = glm::vec2(few_[i].size) / glm::vec2(views[i].size);
        const glm::vec2 offset = glm::vec2(few_[i].corner) - scale * glm::vec2(views[i].corner);
        set_viewport(*gl_, views[i]);
        const PixelBox box = pixel_box(views[i], room_from_box);
        gl_->ScissorIndexed(0, box.low.x, box.low.y, box.high.x - box.low.x,
                            box.high.y - box.low.y);
        gl_->ProgramUniform4f(program, 0, scale.x / whole.x, scale.y / whole.y, offset.x / whole.x,
                              offset.y / whole.y);
        gl_->DrawArrays(GL_TRIANGLES, 0, 3);
    }
    gl_->BindVertexArray(0);
    gl_->UseProgram(0);
    gl_->Enable(GL_FRAMEBUFFER_SRGB);
    gl_->Enable(GL_DEPTH_TEST);
    gl_->Disable(GL_BLEND);
    for (std::size_t i = 0; i < views.size(); ++i)
        set_viewport(*gl_, views[i], static_cast<GLuint>(i));
}

} // namespace isochron::render
