// Color maps from control points and formulas.
#include "render/passes/color_map.h"

#include "render/gl/srgb.h"
#include "render/passes/cielab.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace isochron::render {
namespace {

using Hex = std::span<const std::uint32_t>;

// Colors at equal distances, as their authors publish the maps; straight in L*a*b* between them.
/// S. van der Walt, N. Smith, "A better default colormap for Matplotlib", SciPy 2015.
constexpr std::array kViridis{0x440154u, 0x482878u, 0x3e4989u, 0x31688eu, 0x26828eu,
                              0x1f9e89u, 0x35b779u, 0x6ece58u, 0xb5de2bu, 0xfde725u};
constexpr std::array kInferno{0x000004u, 0x1b0c41u, 0x4a0c6bu, 0x781c6du, 0xa52c60u,
                              0xcf4446u, 0xed6925u, 0xfb9b06u, 0xf7d13du, 0xfcffa4u};
/// J. Nunez, C. Anderton, R. Renslow, "Optimizing colormaps with consideration for color vision
/// deficiency to enable accurate interpretation of scientific data", PLOS ONE 2018,
/// doi:10.1371/journal.pone.0199239.
constexpr std::array kCividis{0x00224eu, 0x123570u, 0x3b496cu, 0x575d6du, 0x707173u,
                              0x8a8678u, 0xa59c74u, 0xc3b369u, 0xe1cc55u, 0xfee838u};

/// A. Mikhailov, "Turbo, an improved rainbow colormap for visualization", Google AI blog 2019.
constexpr std::array kTurbo{0x30123bu, 0x4145abu, 0x4675edu, 0x39a2fcu, 0x1bcfd4u,
                            0x24eca6u, 0x61fc6cu, 0xa4fc3bu, 0xd1e834u, 0xf3c63au,
                            0xfe9b2du, 0xf36315u, 0xd93806u, 0xb11901u, 0x7a0402u};

constexpr float kGrayLow = 32.0f, kGrayHigh = 96.0f; ///< L*

struct OldName {
    std::string_view name;
    ColorMap map;
};
constexpr std::array<OldName, 4> kOldNames{{{"lagoon", ColorMap::viridis},
                                            {"dusk", ColorMap::inferno},
                                            {"polar", ColorMap::coolwarm},
                                            {"grey", ColorMap::gray}}};

glm::vec3 light_of(std::uint32_t hex) {
    return linear_from_srgb(glm::vec3(hex >> 16, hex >> 8 & 0xffu, hex & 0xffu) / 255.0f);
}

std::vector<glm::vec3> lights_of(Hex hex) {
    std::vector<glm::vec3> lights(hex.size());
    std::ranges::transform(hex, lights.begin(), light_of);
    return lights;
}

/// `share` of the whole map at each of its places.
template <class Color>
std::vector<glm::vec3> made_by(Color&& color) {
    std::vector<glm::vec3> colors(kColorMapSize);
    for (std::size_t i = 0; i < kColorMapSize; ++i)
        colors[i] = glm::clamp(color(static_cast<float>(i) / static_cast<float>(kColorMapSize - 1)),
                               0.0f, 1.0f);
    return colors;
}

/// Polar coordinates of L*a*b*: magnitude, saturation, hue.
struct Msh {
    float m, s, h;
};

Msh msh_from(const glm::vec3& lab) {
    const float m = glm::length(lab);
    return {m, std::acos(lab.x / m), std::atan2(lab.z, lab.y)};
}

glm::vec3 light_of(const Msh& msh) {
    const float chroma = msh.m * std::sin(msh.s);
    return linear_from_cielab(
        {msh.m * std::cos(msh.s), chroma * std::cos(msh.h), chroma * std::sin(msh.h)});
}

/// The hue that an unsaturated color gets on the way to a saturated one, which is the darker: a
/// spin that makes up for the change of magnitude.
float spun_hue(const Msh& saturated, float unsaturated_m) {
    if (saturated.m >= unsaturated_m)
        return saturated.h;
    const float spin = saturated.s *
                       std::sqrt(unsaturated_m * unsaturated_m - saturated.m * saturated.m) /
                       (saturated.m * std::sin(saturated.s));
    constexpr float kThird = -1.0471976f; ///< of a half turn, backwards
    return saturated.h > kThird ? saturated.h + spin : saturated.h - spin;
}

/// K. Moreland, "Diverging color maps for scientific visualization", ISVC 2009,
/// doi:10.1007/978-3-642-10520-3_9: from blue and red, whose Msh are alike but for the hue, each
/// straight in Msh to a white in the middle.
glm::vec3 coolwarm(float share) {
    constexpr float kMiddle = 88.0f;
    const bool cold = share < 0.5f;
    const Msh end = msh_from(cielab_from_linear(light_of(cold ? 0x3b4cc0u : 0xb40426u)));
    const float white_m = std::max(kMiddle, end.m), to = cold ? 2 * share : 2 - 2 * share;
    return light_of(Msh{glm::mix(end.m, white_m, to), glm::mix(end.s, 0.0f, to),
                        glm::mix(end.h, spun_hue(end, white_m), to)});
}

} // namespace

std::optional<ColorMap> color_map_from_name(std::string_view name) {
    if (const auto old = std::ranges::find(kOldNames, name, &OldName::name); old != kOldNames.end())
        return old->map;
    const auto found = std::ranges::find(kColorMapNames, name);
    if (found == kColorMapNames.end())
        return std::nullopt;
    return static_cast<ColorMap>(found - kColorMapNames.begin());
}

std::vector<glm::vec3> color_map_between(const std::vector<glm::vec3>& colors) {
    std::vector<glm::vec3> lab(colors.size());
    std::ranges::transform(colors, lab.begin(), cielab_from_linear);
    return made_by([&](float share) {
        const float at = share * static_cast<float>(lab.size() - 1);
        const auto below = static_cast<std::size_t>(at);
        const glm::vec3& next = lab[std::min(below + 1, lab.size() - 1)];
        return linear_from_cielab(glm::mix(lab[below], next, at - static_cast<float>(below)));
    });
}

std::vector<glm::vec3> color_map(ColorMap map) {
    switch (map) {
    case ColorMap::viridis: return color_map_between(lights_of(kViridis));
    case ColorMap::inferno: return color_map_between(lights_of(kInferno));
    case ColorMap::cividis: return color_map_between(lights_of(kCividis));
    case ColorMap::coolwarm: return made_by(coolwarm);
    case ColorMap::turbo: return color_map_between(lights_of(kTurbo));
    case ColorMap::gray: break;
    }
    return made_by([](float share) {
        return linear_from_cielab({glm::mix(kGrayLow, kGrayHigh, share), 0.0f, 0.0f});
    });
}

std::vector<glm::vec3> used(const std::vector<glm::vec3>& map, const ColorMapUse& use) {
    std::vector<glm::vec3> colors = map;
    if (use.reversed)
        std::ranges::reverse(colors);
    if (use.bands == 0)
        return colors;
    std::vector<glm::vec3> parts(colors.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        // From the first color to the last, so that the ends keep theirs.
        const std::size_t band = i * use.bands / parts.size();
        const std::size_t last = std::max(use.bands - 1, 1u);
        parts[i] = use.bands == 1 ? colors[colors.size() / 2]
                                  : colors[(band * (colors.size() - 1) + last / 2) / last];
    }
    return parts;
}

Texture color_map_texture(const Gl& gl, const std::vector<glm::vec3>& colors, bool bands) {
    Texture texture(gl, GL_TEXTURE_1D);
    const auto size = static_cast<GLsizei>(colors.size());
    const GLint filter = bands ? GL_NEAREST : GL_LINEAR;
    gl.TextureStorage1D(texture.name(), 1, GL_RGB16F, size);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl.TextureSubImage1D(texture.name(), 0, 0, size, GL_RGB, GL_FLOAT, colors.data());
    gl.TextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, filter);
    gl.TextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, filter);
    gl.TextureParameteri(texture.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    return texture;
}

const std::array<glm::vec3, index::kMostSurfaces>& surface_palette() {
    static const std::array<glm::vec3, index::kMostSurfaces> kColors = [] {
        constexpr std::array<std::array<int, 3>, 8> kBytes{{{230, 159, 0},
                                                            {86, 180, 233},
                                                            {0, 158, 115},
                                                            {240, 228, 66},
                                                            {0, 114, 178},
                                                            {213, 94, 0},
                                                            {204, 121, 167},
                                                            {200, 200, 200}}};
        std::array<glm::vec3, index::kMostSurfaces> colors;
        for (std::size_t i = 0; i < colors.size(); ++i)
            colors[i] = glm::vec3(kBytes[i][0], kBytes[i][1], kBytes[i][2]) / 255.0f;
        return colors;
    }();
    return kColors;
}

} // namespace isochron::render
