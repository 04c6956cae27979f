// Color maps by the names that the field knows, made from their published definitions.
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
    viridis,  ///< violet over green to yellow, ever lighter: readable with any color vision
    inferno,  ///< black over red to pale yellow, ever lighter
    cividis,  ///< blue to yellow, ever lighter: alike with and without red-green blindness
    coolwarm, ///< blue over light gray to red: for values about a middle
    turbo,    ///< the hues of a rainbow, lightest in the middle: tells most values apart
    gray,     ///< lightness alone, lifted off the dark background
    grayscale ///< black to white
};
inline constexpr std::array<std::string_view, 7> kColorMapNames{
    "viridis", "inferno", "cividis", "coolwarm", "turbo", "gray", "grayscale"};
constexpr std::string_view name_of(ColorMap map) {
    return kColorMapNames[static_cast<std::size_t>(map)];
}
/// What a user reads: the name, and of `gray` how it differs from black to white.
constexpr std::string_view shown_name_of(ColorMap map) {
    return map == ColorMap::gray ? "gray, lifted" : name_of(map);
}
/// Knows the names of older versions too: `lagoon`, `dusk`, `polar`, `grey`.
std::optional<ColorMap> color_map_from_name(std::string_view name);

inline constexpr std::size_t kColorMapSize = 256;

/// The map from low to high, linear light. Lightness L* grows all the way, except in `coolwarm` and
/// `turbo`, where it grows up to the middle and then falls. `gray` starts at 32, so that low values
/// still show their shape before a dark background; `grayscale` goes evenly through display values.
std::vector<glm::vec3> color_map(ColorMap map);

/// A map of kColorMapSize colors, interpolated in L*a*b* between these, which are evenly spaced.
/// @param colors linear light, at least one
std::vector<glm::vec3> color_map_between(const std::vector<glm::vec3>& colors);

/// How a map is used.
struct ColorMapUse {
    bool reversed = false;
    std::uint32_t bands =
        0; ///< number of equal parts with one color each; 0: colors change smoothly
    bool operator==(const ColorMapUse&) const = default;
};
std::vector<glm::vec3> used(const std::vector<glm::vec3>& map, const ColorMapUse& use);

/// Colors as GL_TEXTURE_1D, between which it interpolates. Where they are bands, shaders look in the
/// middle of texels: llvmpipe would compile them once more for a texture that does not interpolate.
/// @param colors kColorMapSize of them
Texture color_map_texture(const Gl& gl, const std::vector<glm::vec3>& colors);

/// Colors for up to eight surfaces that can be told apart with the common kinds of color blindness:
/// the set of M. Okabe and K. Ito, "Color Universal Design", 2002 (jfly.uni-koeln.de/color), with
/// light gray instead of black because the background is dark. sRGB, 0 to 1.
const std::array<glm::vec3, index::kMostSurfaces>& surface_palette();

} // namespace isochron::render
