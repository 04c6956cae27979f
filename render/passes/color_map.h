// Color maps whose equal steps look equal, made from curves in CIE L*a*b*.
#pragma once

#include "index/volume/query.h"
#include "render/gl/gl_objects.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace isochron::render {

enum class ColorMap : std::uint8_t {
    dusk,   ///< violet over red to pale yellow, increasingly light
    lagoon, ///< violet over green to yellow, increasingly light: readable with any color vision
    polar,  ///< blue over light gray to red: for values around a middle
    gray    ///< lightness alone
};
constexpr std::array<std::string_view, 4> kColorMapNames{"dusk", "lagoon", "polar", "gray"};
constexpr std::string_view name_of(ColorMap map) {
    return kColorMapNames[static_cast<std::size_t>(map)];
}
std::optional<ColorMap> color_map_from_name(std::string_view name);

constexpr std::size_t kColorMapSize = 256;

/// The map from low to high, in linear light. Neighbors are equally far apart (Delta E*ab, within a
/// fifth). Lightness L* increases from 32 (`polar`: to the middle, then decreases), so that the
/// shading of low values is still visible on a dark background.
std::vector<glm::vec3> color_map(ColorMap map);

/// The map as GL_TEXTURE_1D that interpolates between its colors.
Texture color_map_texture(const Gl& gl, ColorMap map);

/// Colors for up to eight surfaces that can be told apart with the common kinds of color blindness:
/// the set of M. Okabe and K. Ito, "Color Universal Design", 2002 (jfly.uni-koeln.de/color), with
/// light gray instead of black because the background is dark. sRGB, 0 to 1.
const std::array<glm::vec3, index::kMostSurfaces>& surface_palette();

} // namespace isochron::render
