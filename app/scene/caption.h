// Captions of pictures: isovalues and time in words.
#pragma once

#include "app/scene/overlay_colors.h"
#include "app/scene/picture.h"
#include "index/volume/query.h"
#include "index/volume/volume_series.h"
#include "render/passes/text_pass.h"

#include <string>
#include <vector>

namespace isochron::app {

/// `heart rate, isovalue 8, 12 K, at 0.5 s (step 2 of 6)`.
/// @param further surfaces of other arrays, in words: `temperature 300 K`
std::string caption_text(const index::SurfacesQuery& shown, const index::SeriesInfo& info,
                         const std::vector<std::string>& further = {});

/// `temperature 300 K`, for each surface of another array.
std::vector<std::string> words_of(const std::vector<ShownFurther>& further);

/// `step 2`, or of a moment between two `between steps 2 and 3`: as people count, from 1.
std::string steps_text(index::Instant at);

/// `2`, or of a moment between two steps `2.50`: as people count, from 1.
std::string step_number(index::Instant at);

/// The caption in the upper left corner, for `render::pixel_view`.
/// @param picture its size, pixels @param share height of the words, see `text_height`
std::vector<render::ScreenQuad>
caption_quads(const std::string& words, const render::TextPass& text, const glm::ivec2& picture,
              const OverlayColors& overlay = {}, float share = 0.0f);

/// A title at the bottom, in the middle: two lines at most, half as high again as other words.
/// @param opacity 0 to 1 @param share height of the other words
std::vector<render::ScreenQuad> title_quads(const std::string& words, float opacity,
                                            const render::TextPass& text, const glm::ivec2& picture,
                                            const OverlayColors& overlay = {}, float share = 0.0f);

} // namespace isochron::app
