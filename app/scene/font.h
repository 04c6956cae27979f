// The font of the panel and of text in the room.
#pragma once

#include "render/passes/glyph_atlas.h"

struct ImFontAtlas;

namespace isochron::app {

/// Adds the font with the characters that units need, `pixels` high: DejaVu Sans, or where it is
/// not installed the small bitmap font that Dear ImGui carries.
void add_font(ImFontAtlas& fonts, float pixels);

/// The font for text in the room, rasterized once, `pixels` high.
render::GlyphAtlas room_font(float pixels);

} // namespace isochron::app
