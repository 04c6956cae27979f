// Captions of pictures: isovalues and time in words.
#pragma once

#include "app/scene/ink.h"
#include "index/volume/query.h"
#include "index/volume/volume_series.h"
#include "render/passes/text_pass.h"

#include <string>
#include <vector>

namespace isochron::app {

/// `heart rate, isovalue 8, 12 K, at 0.5 s (step 2 of 6)`.
std::string caption_text(const index::SurfacesQuery& shown, const index::SeriesInfo& info);

/// The caption on its background in the upper left corner, for `render::pixel_view`.
/// @param picture its size, pixels
std::vector<render::ScreenQuad> caption_quads(const std::string& words,
                                              const render::TextPass& text,
                                              const glm::ivec2& picture, const Ink& ink = {});

} // namespace isochron::app
