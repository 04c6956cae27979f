// Adds up pictures in floating point.
#include "render/passes/sample_sum.h"

#include "render/gl/gl_memory.h"
#include "render/gl/shader.h"

#include <cassert>
#include <cstdint>

namespace isochron::render {
namespace {

/// The bits of a number of 32 bits in reverse, as a fraction: the first dimension.
double reversed(std::uint32_t n) {
    double value = 0, digit = 0.5;
    for (; n > 0; n >>= 1, digit /= 2)
        value += (n & 1) != 0 ? digit : 0.0;
    return value;
}

/// The second dimension, whose direction numbers are v_k+1 = v_k xor (v_k / 2).
double second(std::uint32_t n) {
    std::uint32_t bits = 0;
    for (std::uint32_t direction = 1u << 31; n > 0; n >>= 1, direction ^= direction >> 1)
        bits ^= (n & 1) != 0 ? direction : 0u;
    return static_cast<double>(bits) / 4294967296.0;
}

} // namespace

glm::vec2 sample_place(int n, float within) {
    const auto centered = [](double at) { return static_cast<float>(at < 0.5 ? at : at - 1.0); };
    const auto number = static_cast<std::uint32_t>(n);
    return within * glm::vec2(centered(reversed(number)), centered(second(number)));
}

SampleSum::SampleSum(const Gl& gl)
    : gl_(&gl),
      program_(link_program(gl, {shader_file("full_screen.vert"), shader_file("sum.frag")})),
      no_attributes_(gl), framebuffer_(gl) {}

void SampleSum::begin(const RenderTarget& picture) {
    if (!light_ || size_ != picture.size()) {
        size_ = picture.size();
        light_.emplace(*gl_, GL_TEXTURE_2D);
        gl_->TextureStorage2D(light_->name(), 1, GL_RGBA32F, size_.x, size_.y);
        gl_->NamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, light_->name(), 0);
        expect_memory(*gl_, "the samples of a picture");
    }
    draw(framebuffer_.name(), picture.color_texture(), 1.0f, false);
    count_ = 1;
}

void SampleSum::add(const RenderTarget& picture) {
    assert(count_ > 0 && picture.size() == size_);
    draw(framebuffer_.name(), picture.color_texture(), 1.0f, true);
    ++count_;
}

void SampleSum::write_mean(const RenderTarget& target) const {
    assert(count_ > 0 && target.size() == size_);
    draw(target.framebuffer(), light_->name(), 1.0f / static_cast<float>(count_), false);
}

void SampleSum::draw(GLuint framebuffer, GLuint from, float factor, bool adds) const {
    gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl_->Enable(GL_FRAMEBUFFER_SRGB);
    gl_->Viewport(0, 0, size_.x, size_.y);
    gl_->Disable(GL_SCISSOR_TEST);
    gl_->Disable(GL_DEPTH_TEST);
    gl_->Disable(GL_CULL_FACE);
    if (adds) {
        gl_->Enable(GL_BLEND);
        gl_->BlendEquation(GL_FUNC_ADD);
        gl_->BlendFunc(GL_ONE, GL_ONE);
    } else {
        gl_->Disable(GL_BLEND);
    }
    gl_->ProgramUniform1f(program_.name(), 0, factor);
    gl_->BindTextureUnit(0, from);
    gl_->UseProgram(program_.name());
    gl_->BindVertexArray(no_attributes_.name());
    gl_->DrawArrays(GL_TRIANGLES, 0, 3);
    gl_->BindVertexArray(0);
    gl_->UseProgram(0);
    gl_->Disable(GL_BLEND);
    gl_->Enable(GL_DEPTH_TEST);
}

} // namespace isochron::render
