// Draws surfaces that light shines through by the nearest layer of each.
#include "render/passes/layer_pass.h"

#include "render/gl/soft_edges.h"
#include "render/gl/viewport.h"
#include "render/passes/pixel_box.h"

#include <fmt/format.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cassert>

namespace isochron::render {

LayerPass::LayerPass(const Gl& gl) : gl_(&gl), no_attributes_(gl) {
    for (std::size_t layers = 1; layers <= kMost; ++layers)
        programs_.emplace_back(
            gl, std::vector{shader_file("full_screen.vert"), shader_file("layers.frag")},
            fmt::format("#define LAYERS {}\n", layers));
}

void LayerPass::link() const {
    for (const LazyProgram& program : programs_)
        program.name();
}

void LayerPass::draw(std::span<const View> views, std::span<const float> opacities,
                     const std::function<void(std::size_t layer)>& draw, bool hidden, bool linear,
                     const glm::mat4& room_from_box) {
    assert(!opacities.empty() && opacities.size() <= kMost);
    GLint bound = 0;
    gl_->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    const auto picture = static_cast<GLuint>(bound);
    glm::ivec2 size(1);
    for (const View& view : views)
        size = glm::max(size, view.corner + view.size);
    for (std::size_t i = 0; i < opacities.size(); ++i) {
        if (i == layers_.size())
            layers_.emplace_back(*gl_, size);
        RenderTarget& layer = layers_[i];
        layer.resize(size);
        gl_->Disable(GL_SCISSOR_TEST);
        layer.clear(glm::vec4(0.0f));
        if (hidden)
            gl_->BlitNamedFramebuffer(picture, layer.framebuffer(), 0, 0, size.x, size.y, 0, 0,
                                      size.x, size.y, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
        layer.bind();
        gl_->Enable(GL_SCISSOR_TEST);
        draw(i);
    }
    for (std::size_t i = 0; i < opacities.size(); ++i) {
        gl_->BindTextureUnit(static_cast<GLuint>(i), layers_[i].color_texture());
        gl_->BindTextureUnit(static_cast<GLuint>(opacities.size() + i), layers_[i].depth_texture());
    }
    gl_->BindFramebuffer(GL_FRAMEBUFFER, picture);
    const GLuint compose = programs_[opacities.size() - 1].name();
    const auto layers = static_cast<GLsizei>(opacities.size());
    gl_->ProgramUniform1fv(compose, 0, layers, opacities.data());
    gl_->ProgramUniform1i(compose, layers, linear ? 1 : 0);
    if (!linear) // display values, which the target must not convert
        gl_->Disable(GL_FRAMEBUFFER_SRGB);
    gl_->Disable(GL_DEPTH_TEST);
    blend_over(*gl_);
    gl_->UseProgram(compose);
    gl_->BindVertexArray(no_attributes_.name());
    for (const View& view : views) {
        set_viewport(*gl_, view);
        const PixelBox box = pixel_box(view, room_from_box);
        gl_->ScissorIndexed(0, box.low.x, box.low.y, box.high.x - box.low.x,
                            box.high.y - box.low.y);
        gl_->DrawArrays(GL_TRIANGLES, 0, 3);
    }
    gl_->BindVertexArray(0);
    gl_->UseProgram(0);
    gl_->Disable(GL_BLEND);
    gl_->Enable(GL_DEPTH_TEST);
    gl_->Enable(GL_FRAMEBUFFER_SRGB);
    for (std::size_t i = 0; i < views.size(); ++i)
        set_viewport(*gl_, views[i], static_cast<GLuint>(i));
}

} // namespace isochron::render
