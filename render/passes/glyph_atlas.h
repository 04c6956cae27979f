// Pictures of characters in one texture, and where each of them is.
#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace isochron::render {

/// Sizes in heights of a line, so that they hold for every size of text; y goes down from the top
/// of the line.
struct Glyph {
    /// Its rectangle, from where the pen stands; with a margin, so that its edge is filtered.
    glm::vec2 low{0.0f}, high{0.0f};
    glm::vec2 texture_low{0.0f}, texture_high{0.0f}; ///< the same in the atlas, 0 to 1
    float advance = 0.0f;                            ///< of the pen
};

struct GlyphAtlas {
    glm::ivec2 size{0};                 ///< texels
    std::vector<std::uint8_t> coverage; ///< 0 to 255, row after row
    glm::vec2 solid{0.0f};              ///< a place of full coverage, 0 to 1
    std::unordered_map<char32_t, Glyph> glyphs;

    /// Null for a character that the font lacks.
    const Glyph* find(char32_t character) const;
};

/// The characters of UTF-8 text; what is no UTF-8 becomes U+FFFD.
std::u32string characters(const std::string& utf8);

/// Width of a line in heights of a line. Characters that the font lacks take no room.
float text_width(const GlyphAtlas& atlas, const std::string& utf8);

} // namespace isochron::render
