// The font, rasterized by Dear ImGui.
#include "app/scene/font.h"

#include "index/system/input_file.h"

#include <imgui.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>

namespace isochron::app {
namespace {

constexpr const char* kFontFile = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr std::uint64_t kMostBytes = 64 << 20; ///< largest font file
constexpr int kAcross = 3; ///< texels of a pixel's width, whatever the version's own choice is

/// How far a halo reaches around letters [pixel].
int halo_of(int pixels) {
    return std::max(2, pixels / 10);
}

/// A glyph with a margin around it, so that its edges are filtered correctly at any position
/// between pixels, and its halo has room.
render::Glyph with_margin(const ImFontGlyph& glyph, float line, float margin) {
    render::Glyph result{.advance = glyph.AdvanceX / line};
    if (!glyph.Visible || !(glyph.X1 > glyph.X0) || !(glyph.Y1 > glyph.Y0))
        return result;
    const glm::vec2 low(glyph.X0, glyph.Y0), high(glyph.X1, glyph.Y1);
    const glm::vec2 texture_low(glyph.U0, glyph.V0), texture_high(glyph.U1, glyph.V1);
    const glm::vec2 texture_margin = margin * (texture_high - texture_low) / (high - low);
    result.low = (low - margin) / line;
    result.high = (high + margin) / line;
    result.texture_low = texture_low - texture_margin;
    result.texture_high = texture_high + texture_margin;
    return result;
}

} // namespace

void add_font(ImFontAtlas& fonts, float pixels) {
    // Latin, Greek, punctuation and superscripts, letter-like signs, mathematics: what units need.
    static constexpr ImWchar kGlyphs[]{0x20,   0xff,   0x370,  0x3ff,  0x2010, 0x209f,
                                       0x2100, 0x214f, 0x2190, 0x22ff, 0};
    // Nearly every desktop has this font; the built-in bitmap font is readable but small.
    std::error_code ignored;
    if (!std::filesystem::exists(kFontFile, ignored)) {
        fonts.AddFontDefault();
        return;
    }
    const std::string file = index::read_text(kFontFile, kMostBytes);
    void* owned = ImGui::MemAlloc(file.size());
    std::memcpy(owned, file.data(), file.size());
    ImFontConfig config;
    config.OversampleH = kAcross;
    fonts.AddFontFromMemoryTTF(owned, static_cast<int>(file.size()), pixels, &config, kGlyphs);
}

render::GlyphAtlas room_font(int pixels) {
    const int halo = halo_of(pixels);
    ImFontAtlas fonts;
    fonts.TexGlyphPadding = 2 * kAcross * (halo + 1) + 1; // margins must not meet
    add_font(fonts, static_cast<float>(pixels));
    unsigned char* coverage = nullptr;
    render::GlyphAtlas atlas;
    fonts.GetTexDataAsAlpha8(&coverage, &atlas.size.x, &atlas.size.y);
    atlas.coverage.assign(coverage, coverage + std::size_t{1} * atlas.size.x * atlas.size.y);
    atlas.halo = {kAcross * halo, halo};
    const ImFont& font = *fonts.Fonts.front();
    const float line = font.FontSize;
    for (const ImFontGlyph& glyph : font.Glyphs)
        atlas.glyphs[glyph.Codepoint] = with_margin(glyph, line, static_cast<float>(halo) + 1.0f);
    return atlas;
}

} // namespace isochron::app
