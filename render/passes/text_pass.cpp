// Buffers and GL state for drawing text.
#include "render/passes/text_pass.h"

#include "render/gl/limits.h"
#include "render/gl/soft_edges.h"
#include "render/gl/viewport.h"

#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace isochron::render {

namespace {

constexpr int kMeasured = 32; ///< [pixel] height of the letters that text is measured with
constexpr std::size_t kMostHeights = 8; ///< heights whose letters are kept

Texture texture_of_letters(const Gl& gl, const GlyphAtlas& atlas) {
    Texture texture(gl, GL_TEXTURE_2D);
    expect_texture(Limits(gl), "font", atlas.size);
    const std::vector<std::uint8_t> halos = halos_of(atlas);
    std::vector<std::uint8_t> both(2 * halos.size());
    for (std::size_t i = 0; i < halos.size(); ++i) {
        both[2 * i] = atlas.coverage[i];
        both[2 * i + 1] = halos[i];
    }
    gl.TextureStorage2D(texture.name(), 1, GL_RG8, atlas.size.x, atlas.size.y);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl.TextureSubImage2D(texture.name(), 0, 0, 0, atlas.size.x, atlas.size.y, GL_RG,
                         GL_UNSIGNED_BYTE, both.data());
    gl.TextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.TextureParameteri(texture.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TextureParameteri(texture.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

} // namespace

TextPass::TextPass(const Gl& gl, Font font)
    : gl_(&gl), font_(std::move(font)), measured_(font_(kMeasured)),
      program_(gl, {shader_file("text.vert"), shader_file("text.frag")}), quads_(gl),
      placed_(gl, "characters", sizeof(ScreenQuad) / sizeof(glm::vec4)), frame_(gl) {}

TextPass::TextPass(const Gl& gl, const GlyphAtlas& atlas)
    : TextPass(gl, [atlas](int) { return atlas; }) {}

const TextPass::Letters& TextPass::letters(float height) const {
    const int pixels = std::max(1, static_cast<int>(std::lround(height)));
    const auto found = std::ranges::find(letters_, pixels, &Letters::pixels);
    if (found != letters_.end())
        return *found;
    if (letters_.size() == kMostHeights)
        letters_.pop_back();
    GlyphAtlas atlas = font_(pixels);
    Texture texture = texture_of_letters(*gl_, atlas);
    return letters_.emplace_front(std::move(atlas), std::move(texture), pixels);
}

GLuint TextPass::texture_of(const ScreenQuad& quad) const {
    return letters(std::floor(0.5f * quad.letters)).texture.name();
}

void TextPass::set(const Label& label, float height, std::vector<ScreenQuad>& quads) const {
    const Letters& letters = this->letters(height);
    const glm::vec2 size(text_width(measured_, label.text), 1.0f);
    const glm::vec2 begin =
        glm::round(height * (label.offset - label.anchor * size + glm::vec2(0.0f, 1.0f)));
    for (const bool halo : {true, false}) {
        const glm::vec4& color = halo ? label.halo : label.color;
        if (!(color.w > 0.0f))
            continue;
        glm::vec2 pen = begin; // top of the line
        for (const char32_t character : characters(label.text)) {
            const Glyph* glyph = letters.atlas.find(character);
            if (!glyph)
                continue;
            quads.push_back({.at = label.at,
                             .letters = static_cast<float>(2 * letters.pixels + (halo ? 1 : 0)),
                             .low = pen + height * glm::vec2(glyph->low.x, -glyph->high.y),
                             .high = pen + height * glm::vec2(glyph->high.x, -glyph->low.y),
                             .texture_low = {glyph->texture_low.x, glyph->texture_high.y},
                             .texture_high = {glyph->texture_high.x, glyph->texture_low.y},
                             .color = color});
            pen.x += height * glyph->advance;
        }
    }
}

void TextPass::fill(const glm::vec3& at, const glm::vec2& low, const glm::vec2& high,
                    const glm::vec4& color, std::vector<ScreenQuad>& quads) const {
    quads.push_back({.at = at, .low = low, .high = high, .color = color});
}

void TextPass::draw(const View& view, const glm::mat4& room_from_model,
                    std::span<const ScreenQuad> quads, Depth depth, bool whole_pixels) {
    if (quads.empty())
        return;
    struct Frame {
        glm::mat4 clip_from_model;
        glm::vec4 size;
    } frame{view.steady().clip_from_eye * view.eye_from_room * room_from_model,
            glm::vec4(view.size, whole_pixels ? 1.0f : 0.0f, 0.0f)};
    gl_->BindBufferBase(GL_UNIFORM_BUFFER, 0, frame_.name());
    set_viewport(*gl_, view);
    const bool tested = depth == Depth::tested;
    (tested ? gl_->Enable : gl_->Disable)(GL_DEPTH_TEST);
    gl_->DepthFunc(GL_LEQUAL);
    gl_->Disable(GL_CULL_FACE);
    blend_over(*gl_);
    gl_->UseProgram(program_.name());
    const auto of_one_height = [](const ScreenQuad& a, const ScreenQuad& b) {
        return a.letters == 0 || b.letters == 0 ||
               std::floor(0.5f * a.letters) == std::floor(0.5f * b.letters);
    };
    while (!quads.empty()) {
        // All up to the first of another height; plain ones, which need no letters, go with any.
        const auto lettered =
            std::ranges::find_if(quads, [](const ScreenQuad& quad) { return quad.letters > 0; });
        const auto end = lettered == quads.end()
                             ? lettered
                             : std::find_if(lettered, quads.end(), [&](const ScreenQuad& quad) {
                                   return !of_one_height(*lettered, quad);
                               });
        const auto run = quads.first(static_cast<std::size_t>(end - quads.begin()));
        if (lettered != quads.end())
            gl_->BindTextureUnit(1, texture_of(*lettered));
        placed_.set(std::as_bytes(run));
        gl_->BindTextureUnit(0, placed_.texture());
        draw_colors_then_depth(*gl_, tested, [&](bool depth_only) {
            constexpr float kCore = 0.5f;
            frame.size.w = depth_only ? kCore : 0.0f;
            gl_->NamedBufferData(frame_.name(), sizeof(frame), &frame, GL_STREAM_DRAW);
            quads_.draw(run.size());
        });
        quads = quads.subspan(run.size());
    }
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
