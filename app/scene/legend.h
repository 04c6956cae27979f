// The legend of the colors. It is drawn into every eye's picture, so captures and walls have it
// too.
#pragma once

#include "app/scene/color_scale.h"
#include "app/scene/overlay_colors.h"
#include "index/volume/value_type.h"
#include "render/passes/text_pass.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::app {

/// A line of the legend: a color, and what has it.
struct LegendLine {
    std::optional<glm::vec3> color; ///< sRGB; none: that of its values
    std::string words;
};

struct Legend {
    std::span<const interaction::Isosurface>
        surfaces;                      ///< those that are seen are listed if there are several
    std::string value_unit;            ///< unit of their isovalues
    int digits = index::kFewestDigits; ///< significant ones of their isovalues
    std::vector<ColorScale> scales;    ///< scales of colored surfaces and of slices, from below
    bool colored = false;              ///< surfaces are colored by the first of them
    OverlayColors overlay{};
    std::string array{}; ///< that has the isovalues; stands over them where the scale is another's
    std::vector<LegendLine> further{}; ///< surfaces of other arrays
    std::vector<LegendLine> ghosts{};  ///< by time
};

/// Height of text in a picture [pixel], a whole number.
/// @param share of the picture's height, and 11 pixels at least; 0: a fortieth, from 11 to 40 pixels
float text_height(const glm::ivec2& picture, float share = 0.0f);

/// Factor of the width of lines, which grow with text of a chosen height, as on dense displays.
float line_scale(const glm::ivec2& picture, float share);

/// Rectangles for `pixel_view`, at the lower right of the picture; empty if there is nothing to
/// explain, or no room.
/// @param share height of the words, see `text_height`
/// @param highest where something else begins above it [pixel]; the bars of scales are shorter where
/// they have no room below it. 0: nothing does
std::vector<render::ScreenQuad> legend_quads(const Legend& legend, const render::TextPass& text,
                                             const glm::ivec2& picture, float share = 0.0f,
                                             float highest = 0.0f);

} // namespace isochron::app
