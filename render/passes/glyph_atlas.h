// Pictures of characters in one texture, and their places.
#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace isochron::render {

/// Sizes are in heights of a line, for any size of text; y goes down from the top of the line.
struct Glyph {
    /// Its rectangle relative to the pen; with a margin, so that its edge is filtered.
    glm::vec2 low{0.0f}, high{0.0f};
    glm::vec2 texture_low{0.0f}, texture_high{0.0f}; ///< its rectangle in the atlas, 0 to 1
    float advance = 0.0f;                            ///< advance of the pen to the next character
};

struct GlyphAtlas {
    glm::ivec2 size{0};                 ///< texels
    std::vector<std::uint8_t> coverage; ///< 0 to 255, row after row
    /// How far a halo reaches around a glyph, across and up [texel]: less than glyphs' margins.
    glm::ivec2 halo{0};
    std::unordered_map<char32_t, Glyph> glyphs;

    /// The glyph of a character; null if the font lacks it.
    const Glyph* find(char32_t character) const;
};

/// The characters of UTF-8 text; invalid bytes become U+FFFD.
std::u32string characters(const std::string& utf8);

/// The coverage of the halos, in the order of `coverage`: that of the glyphs, as far spread as halos
/// reach.
std::vector<std::uint8_t> halos_of(const GlyphAtlas& atlas);

/// Width of a line of text, in heights of a line. Characters that the font lacks have no width.
float text_width(const GlyphAtlas& atlas, const std::string& utf8);

} // namespace isochron::render
