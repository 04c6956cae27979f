// The font of the panel and of text in the room.
#pragma once

#include "render/passes/glyph_atlas.h"

struct ImFontAtlas;

namespace isochron::app {

/// Adds the font with the characters that units need, `pixels` high: DejaVu Sans, or if that is not
/// installed, the small bitmap font of Dear ImGui.
void add_font(ImFontAtlas& fonts, float pixels);

/// Rasterizes the font for text in the room, `pixels` high.
render::GlyphAtlas room_font(int pixels);

} // namespace isochron::app
