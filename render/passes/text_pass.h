// Draws text at places in the room, parallel to the screen, and plain rectangles.
//
//     TextPass text(gl, font);
//     std::vector<ScreenQuad> quads;
//     text.set({.text = "20 mm", .at = {0, 0, 20}}, 14.0f, quads);
//     text.draw(view, room_from_index, quads);
#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/quad_indices.h"
#include "render/gl/shader.h"
#include "render/gl/texel_buffer.h"
#include "render/gl/view.h"
#include "render/passes/glyph_atlas.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <deque>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace isochron::render {

/// One line of text at a point.
struct Label {
    std::string text;                        ///< UTF-8
    glm::vec3 at{0.0f};                      ///< model space
    glm::vec2 anchor{0.5f};                  ///< part of the text that is at `at`: 0 left, bottom
    glm::vec2 offset{0.0f};                  ///< from `at`, in heights of the text, up positive
    glm::vec4 color{1.0f, 1.0f, 1.0f, 1.0f}; ///< sRGB, not pre-multiplied; a: opacity
    glm::vec4 halo{0.0f};                    ///< color around the characters; a is 0: there is none
};

/// Rasterizes a font. @param pixels height of a line
using Font = std::function<GlyphAtlas(int pixels)>;

/// A rectangle on the screen, in the shader's layout: one character, or one plain area.
struct ScreenQuad {
    glm::vec3 at{0.0f};              ///< place that it is attached to, model space
    float letters = 0.0f;            ///< twice the height of its font [pixel], and 1 for a halo
    glm::vec2 low{0.0f}, high{0.0f}; ///< from `at`, pixels, up positive
    glm::vec2 texture_low{0.0f}, texture_high{0.0f};
    glm::vec4 color{1.0f}; ///< as in Label
};
static_assert(sizeof(ScreenQuad) == 16 * sizeof(float));

class TextPass {
  public:
    /// Text is drawn from letters that are rasterized at its height.
    /// @throws Error when a shader does not compile
    TextPass(const Gl& gl, Font font);
    /// All text is drawn from these letters, which are scaled.
    TextPass(const Gl& gl, const GlyphAtlas& atlas);

    /// Letters from which text is measured: their widths are alike at all heights.
    const GlyphAtlas& atlas() const { return measured_; }

    /// Appends the characters of a label, which begins at a whole pixel from its place; below them
    /// its halo.
    /// @param height of a line, whole pixels
    void set(const Label& label, float height, std::vector<ScreenQuad>& quads) const;

    /// Appends a plain rectangle.
    void fill(const glm::vec3& at, const glm::vec2& low, const glm::vec2& high,
              const glm::vec4& color, std::vector<ScreenQuad>& quads) const;

    enum class Depth : std::uint8_t {
        tested, ///< depth is tested, and written for characters' cores: draw text before splats
        none    ///< drawn over everything
    };
    /// Draws into the view's viewport of the bound framebuffer. Each quad has the depth of its
    /// place `at` and is parallel to the screen, so that both eyes see upright text at that depth.
    /// Quads behind the eye are left out. Leaves depth test and depth writes on, blending and
    /// culling off.
    /// @param whole_pixels places are moved to the nearest whole pixel, which keeps letters sharp;
    /// not where two eyes see them, as that would change their depth
    void draw(const View& view, const glm::mat4& room_from_model, std::span<const ScreenQuad> quads,
              Depth depth = Depth::tested, bool whole_pixels = false);

  private:
    /// The letters of one height.
    struct Letters {
        GlyphAtlas atlas;
        Texture texture; ///< coverage of letters and of halos
        int pixels;      ///< height of a line
    };
    const Letters& letters(float height) const;
    GLuint texture_of(const ScreenQuad& quad) const;

    const Gl* gl_;
    Font font_;
    GlyphAtlas measured_;
    LazyProgram program_;
    QuadIndices quads_;
    TexelBuffer placed_;
    Buffer frame_;
    mutable std::deque<Letters> letters_; ///< made when they are first needed, the newest first
};

/// A view whose room coordinates are pixels: x and y from the viewport's lower left, z 0.
View pixel_view(const View& view);

} // namespace isochron::render
