// Orientation for the viewer: the data's axes in a corner of the picture, and a scale bar.
#pragma once

#include "app/scene/overlay_colors.h"
#include "index/volume/volume_series.h"
#include "interaction/pose.h"
#include "render/gl/view.h"
#include "render/passes/line_pass.h"
#include "render/passes/text_pass.h"

#include <optional>
#include <vector>

namespace isochron::app {

/// The contents of the lower left corner, for `render::pixel_view`.
struct Orientation {
    std::vector<render::Line> lines;       ///< farther ones first
    std::vector<render::ScreenQuad> quads; ///< letters, the bar and its length
};

/// A scale bar of a round length in the data's units, valid at the data's center.
struct ScaleBar {
    double length = 0; ///< physical units
    float pixels = 0;  ///< length in the picture
};
/// Its length is the largest 1, 2 or 5 times a power of ten that takes at most a fifth of the
/// picture's width. Empty if the center is behind the eye.
/// @param center of the data, physical space
std::optional<ScaleBar> scale_bar(const render::View& view,
                                  const interaction::Similarity& room_from_physical,
                                  const glm::dvec3& center);

/// @param share height of the words, see `text_height`
/// @param highest where something else begins above the axes [pixel], which are shorter there or left
/// out; 0: nothing does
Orientation orientation_in(const render::View& view,
                           const interaction::Similarity& room_from_physical,
                           const index::SeriesInfo& info, const render::TextPass& text,
                           const OverlayColors& overlay = {}, float share = 0.0f,
                           float highest = 0.0f);

} // namespace isochron::app
