// Finds the glyphs of a text, and its width.
#include "render/passes/glyph_atlas.h"

namespace isochron::render {

const Glyph* GlyphAtlas::find(char32_t character) const {
    const auto found = glyphs.find(character);
    return found == glyphs.end() ? nullptr : &found->second;
}

std::u32string characters(const std::string& utf8) {
    constexpr char32_t kUnknown = 0xfffd;
    std::u32string result;
    for (std::size_t i = 0; i < utf8.size();) {
        const auto first = static_cast<unsigned char>(utf8[i++]);
        int more = first < 0x80 ? 0 : first < 0xc2 ? -1 : first < 0xe0 ? 1 : first < 0xf0 ? 2 : 3;
        if (first > 0xf4)
            more = -1;
        char32_t character = more <= 0 ? first : first & (0x3f >> more);
        for (; more > 0 && i < utf8.size() && (utf8[i] & 0xc0) == 0x80; --more)
            character = character << 6 | (utf8[i++] & 0x3f);
        result += more == 0 ? character : kUnknown;
    }
    return result;
}

float text_width(const GlyphAtlas& atlas, const std::string& utf8) {
    float width = 0.0f;
    for (const char32_t character : characters(utf8))
        if (const Glyph* glyph = atlas.find(character))
            width += glyph->advance;
    return width;
}

} // namespace isochron::render
