// Buffers and GL state for drawing text.
#include "render/passes/text_pass.h"

#include "render/gl/limits.h"
#include "render/gl/soft_edges.h"
#include "render/gl/viewport.h"

#include <glm/gtc/matrix_transform.hpp>

#include <utility>

namespace isochron::render {

TextPass::TextPass(const Gl& gl, GlyphAtlas atlas)
    : gl_(&gl), atlas_(std::move(atlas)),
      program_(gl, {shader_file("text.vert"), shader_file("text.frag")}), quads_(gl),
      placed_(gl, "characters", sizeof(ScreenQuad) / sizeof(glm::vec4)), frame_(gl),
      glyphs_(gl, GL_TEXTURE_2D) {
    // Glyphs are rasterized larger than they are drawn, so that text is smooth at any size and
    // place.
    constexpr GLsizei kLevels = 4;
    expect_texture(Limits(gl), "font", atlas_.size);
    gl.TextureStorage2D(glyphs_.name(), kLevels, GL_R8, atlas_.size.x, atlas_.size.y);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl.TextureSubImage2D(glyphs_.name(), 0, 0, 0, atlas_.size.x, atlas_.size.y, GL_RED,
                         GL_UNSIGNED_BYTE, atlas_.coverage.data());
    gl.GenerateTextureMipmap(glyphs_.name());
    gl.TextureParameteri(glyphs_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl.TextureParameteri(glyphs_.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.TextureParameteri(glyphs_.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TextureParameteri(glyphs_.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void TextPass::set(const Label& label, float height, std::vector<ScreenQuad>& quads) const {
    const glm::vec2 size(text_width(atlas_, label.text), 1.0f);
    glm::vec2 pen = label.offset - label.anchor * size + glm::vec2(0.0f, 1.0f); // top of the line
    for (const char32_t character : characters(label.text)) {
        const Glyph* glyph = atlas_.find(character);
        if (!glyph)
            continue;
        const glm::vec2 low(pen.x + glyph->low.x, pen.y - glyph->high.y);
        const glm::vec2 high(pen.x + glyph->high.x, pen.y - glyph->low.y);
        quads.push_back({.at = label.at,
                         .low = height * low,
                         .high = height * high,
                         .texture_low = {glyph->texture_low.x, glyph->texture_high.y},
                         .texture_high = {glyph->texture_high.x, glyph->texture_low.y},
                         .color = label.color});
        pen.x += glyph->advance;
    }
}

void TextPass::fill(const glm::vec3& at, const glm::vec2& low, const glm::vec2& high,
                    const glm::vec4& color, std::vector<ScreenQuad>& quads) const {
    quads.push_back({.at = at,
                     .low = low,
                     .high = high,
                     .texture_low = atlas_.solid,
                     .texture_high = atlas_.solid,
                     .color = color});
}

void TextPass::draw(const View& view, const glm::mat4& room_from_model,
                    std::span<const ScreenQuad> quads, Depth depth) {
    if (quads.empty())
        return;
    struct Frame {
        glm::mat4 clip_from_model;
        glm::vec4 size;
    } frame{view.clip_from_eye * view.eye_from_room * room_from_model,
            glm::vec4(view.size, 0.0f, 0.0f)};
    placed_.set(std::as_bytes(quads));
    gl_->BindBufferBase(GL_UNIFORM_BUFFER, 0, frame_.name());
    gl_->BindTextureUnit(0, placed_.texture());
    gl_->BindTextureUnit(1, glyphs_.name());

    set_viewport(*gl_, view);
    const bool tested = depth == Depth::tested;
    (tested ? gl_->Enable : gl_->Disable)(GL_DEPTH_TEST);
    gl_->DepthFunc(GL_LEQUAL);
    gl_->Disable(GL_CULL_FACE);
    blend_over(*gl_);
    gl_->UseProgram(program_.name());
    draw_colors_then_depth(*gl_, tested, [&](bool depth_only) {
        constexpr float kCore = 0.5f;
        frame.size.w = depth_only ? kCore : 0.0f;
        gl_->NamedBufferData(frame_.name(), sizeof(frame), &frame, GL_STREAM_DRAW);
        quads_.draw(quads.size());
    });
    gl_->DepthFunc(GL_LESS);
    gl_->Enable(GL_DEPTH_TEST);
    gl_->Disable(GL_BLEND);
    gl_->UseProgram(0);
}

View pixel_view(const View& view) {
    const glm::vec2 size(view.size);
    return {.clip_from_eye = glm::ortho(0.0f, size.x, 0.0f, size.y, -1.0f, 1.0f),
            .eye_from_room = glm::mat4(1.0f),
            .size = view.size,
            .corner = view.corner};
}

} // namespace isochron::render
