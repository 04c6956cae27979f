// Finds the glyphs of a text, and its width.
#include "render/passes/glyph_atlas.h"

#include <algorithm>
#include <cmath>

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

std::vector<std::uint8_t> halos_of(const GlyphAtlas& atlas) {
    const int width = atlas.size.x, height = atlas.size.y;
    std::vector<std::uint8_t> halos = atlas.coverage, wide(static_cast<std::size_t>(width));
    for (int up = 0; up <= atlas.halo.y; ++up) {
        const float share = static_cast<float>(up) / (static_cast<float>(atlas.halo.y) + 0.5f);
        const int across = static_cast<int>(
            std::lround(static_cast<float>(atlas.halo.x) * std::sqrt(1.0f - share * share)));
        for (int y = 0; y < height; ++y) {
            const std::uint8_t* row = atlas.coverage.data() + std::ptrdiff_t{1} * y * width;
            if (std::all_of(row, row + width, [](std::uint8_t value) { return value == 0; }))
                continue;
            std::copy_n(row, width, wide.begin());
            for (int by = 1; by <= across; ++by)
                for (int x = by; x < width - by; ++x)
                    wide[x] = std::max({wide[x], row[x - by], row[x + by]});
            for (const int to : {y - up, y + up}) {
                if (to < 0 || to >= height)
                    continue;
                std::uint8_t* halo = halos.data() + std::ptrdiff_t{1} * to * width;
                for (int x = 0; x < width; ++x)
                    halo[x] = std::max(halo[x], wide[x]);
            }
        }
    }
    return halos;
}

float text_width(const GlyphAtlas& atlas, const std::string& utf8) {
    float width = 0.0f;
    for (const char32_t character : characters(utf8))
        if (const Glyph* glyph = atlas.find(character))
            width += glyph->advance;
    return width;
}

} // namespace isochron::render
