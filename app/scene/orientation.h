// Where one is: the data's axes in a corner of the picture, and a bar of a round length.
#pragma once

#include "index/volume/volume_series.h"
#include "interaction/pose.h"
#include "render/gl/view.h"
#include "render/passes/line_pass.h"
#include "render/passes/text_pass.h"

#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// What stands in the lower left corner, for `render::pixel_view`.
struct Orientation {
    std::vector<render::Line> lines;       ///< farther ones first
    std::vector<render::ScreenQuad> quads; ///< letters, the bar and its length
};

/// A bar of a round length in the data's units, as long as it is seen at the data's center.
struct ScaleBar {
    double length = 0; ///< physical
    float pixels = 0;
};
/// The largest of 1, 2 or 5 times a power of ten that takes at most a fifth of the picture's width;
/// nothing where the center is behind the eye.
/// @param center of the data, physical space
std::optional<ScaleBar> scale_bar(const render::View& view,
                                  const interaction::Similarity& room_from_physical,
                                  const glm::dvec3& center);

Orientation orientation_in(const render::View& view,
                           const interaction::Similarity& room_from_physical,
                           const index::SeriesInfo& info, const render::TextPass& text);

} // namespace isochron::app
