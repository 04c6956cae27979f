// What the colors mean, written into every eye's picture: so captures and walls have it too.
#pragma once

#include "app/scene/color_scale.h"
#include "interaction/commands.h"
#include "render/passes/text_pass.h"

#include <glm/vec2.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::app {

struct Legend {
    std::span<const interaction::Isosurface> surfaces; ///< listed when there are several
    std::string value_unit;                            ///< of their isovalues
    std::optional<ColorScale> scale;                   ///< what stands for the surfaces' colors
};

/// Height of text in a picture: a fortieth of it, as long as that can be read.
float text_height(const glm::ivec2& picture);

/// Rectangles for `pixel_view`, at the lower right of the picture; none when there is nothing to
/// explain or no room for it.
std::vector<render::ScreenQuad> legend_quads(const Legend& legend, const render::TextPass& text,
                                             const glm::ivec2& picture);

} // namespace isochron::app
