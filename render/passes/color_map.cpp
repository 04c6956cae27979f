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

// Colors at equal distances, of the tables of 256 that their authors publish (every fifth, as in
// Matplotlib's _cm_listed.py); straight in L*a*b* between them.
/// S. van der Walt, N. Smith, "A better default colormap for Matplotlib", SciPy 2015.
constexpr std::array kViridis{
    0x440154u, 0x46085cu, 0x471063u, 0x481769u, 0x481d6fu, 0x482475u, 0x472a7au, 0x46307eu,
    0x453781u, 0x433d84u, 0x414287u, 0x3f4889u, 0x3d4e8au, 0x3a538bu, 0x38598cu, 0x355e8du,
    0x33638du, 0x31688eu, 0x2e6d8eu, 0x2c718eu, 0x2a768eu, 0x297b8eu, 0x27808eu, 0x25848eu,
    0x23898eu, 0x218e8du, 0x20928cu, 0x1f978bu, 0x1e9c89u, 0x1fa188u, 0x21a585u, 0x24aa83u,
    0x28ae80u, 0x2eb37cu, 0x35b779u, 0x3dbc74u, 0x46c06fu, 0x50c46au, 0x5ac864u, 0x65cb5eu,
    0x70cf57u, 0x7cd250u, 0x89d548u, 0x95d840u, 0xa2da37u, 0xb0dd2fu, 0xbddf26u, 0xcae11fu,
    0xd8e219u, 0xe5e419u, 0xf1e51du, 0xfde725u};
constexpr std::array kInferno{
    0x000004u, 0x02020cu, 0x050417u, 0x0a0722u, 0x10092du, 0x160b39u, 0x1e0c45u, 0x260c51u,
    0x2f0a5bu, 0x380962u, 0x400a67u, 0x490b6au, 0x510e6cu, 0x59106eu, 0x61136eu, 0x69166eu,
    0x71196eu, 0x781c6du, 0x801f6cu, 0x88226au, 0x902568u, 0x982766u, 0xa02a63u, 0xa82e5fu,
    0xb0315bu, 0xb73557u, 0xbf3952u, 0xc63d4du, 0xcc4248u, 0xd34743u, 0xd94d3du, 0xdf5337u,
    0xe45a31u, 0xe9612bu, 0xed6925u, 0xf1711fu, 0xf47918u, 0xf78212u, 0xf98b0bu, 0xfa9407u,
    0xfb9d07u, 0xfca60cu, 0xfcb014u, 0xfbba1fu, 0xfac42au, 0xf8cd37u, 0xf6d746u, 0xf4e156u,
    0xf2ea69u, 0xf2f27du, 0xf5f992u, 0xfcffa4u};
/// J. Nunez, C. Anderton, R. Renslow, "Optimizing colormaps with consideration for color vision
/// deficiency to enable accurate interpretation of scientific data", PLOS ONE 2018,
/// doi:10.1371/journal.pone.0199239.
constexpr std::array kCividis{
    0x00224eu, 0x002656u, 0x002a5fu, 0x002d68u, 0x003070u, 0x083370u, 0x163770u, 0x203a6fu,
    0x273e6eu, 0x2e416du, 0x34456cu, 0x3a486cu, 0x3f4c6cu, 0x444f6cu, 0x49536cu, 0x4e566cu,
    0x535a6du, 0x575d6du, 0x5c616eu, 0x60646fu, 0x656870u, 0x696b71u, 0x6d6f72u, 0x727274u,
    0x767676u, 0x7a7a78u, 0x7e7d78u, 0x838179u, 0x888578u, 0x8d8878u, 0x928c78u, 0x969077u,
    0x9b9476u, 0xa09875u, 0xa59c74u, 0xaaa073u, 0xafa471u, 0xb5a86fu, 0xbaac6du, 0xbfb06bu,
    0xc4b468u, 0xc9b965u, 0xcfbd62u, 0xd4c15fu, 0xdac65bu, 0xdfca57u, 0xe5cf52u, 0xead34cu,
    0xf0d846u, 0xf6dd3fu, 0xfce236u, 0xfee838u};
/// A. Mikhailov, "Turbo, an improved rainbow colormap for visualization", Google AI blog 2019.
constexpr std::array kTurbo{
    0x30123bu, 0x36215fu, 0x3b2f80u, 0x3f3e9cu, 0x424bb5u, 0x4559cbu, 0x4666ddu, 0x4773ebu,
    0x4680f6u, 0x458cfdu, 0x4099ffu, 0x38a5fbu, 0x2fb2f4u, 0x27bee9u, 0x1fc9ddu, 0x1ad4d0u,
    0x18ddc2u, 0x1ae4b6u, 0x22ebaau, 0x2ff19bu, 0x3ff68au, 0x52fa7au, 0x65fd69u, 0x79fe59u,
    0x8bff4bu, 0x9cfe40u, 0xa9fb39u, 0xb7f735u, 0xc3f134u, 0xd0ea34u, 0xdbe236u, 0xe5d938u,
    0xeecf3au, 0xf5c53au, 0xfaba39u, 0xfdae35u, 0xfea130u, 0xfe932au, 0xfc8423u, 0xf9751du,
    0xf46617u, 0xef5811u, 0xe84b0cu, 0xe14109u, 0xd83706u, 0xce2d04u, 0xc32503u, 0xb71d02u,
    0xa91601u, 0x9b0f01u, 0x8b0902u, 0x7a0403u};

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

/// The hue that an unsaturated color gets on the way to a saturated, darker color: it is turned as
/// far as makes up for the change of magnitude.
float spun_hue(const Msh& saturated, float unsaturated_m) {
    if (saturated.m >= unsaturated_m)
        return saturated.h;
    const float spin = saturated.s *
                       std::sqrt(unsaturated_m * unsaturated_m - saturated.m * saturated.m) /
                       (saturated.m * std::sin(saturated.s));
    constexpr float kThird = -1.0471976f; ///< a third of a half turn, backwards
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
    case ColorMap::grayscale:
        return made_by([](float share) { return linear_from_srgb(glm::vec3(share)); });
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

Texture color_map_texture(const Gl& gl, const std::vector<glm::vec3>& colors) {
    Texture texture(gl, GL_TEXTURE_1D);
    const auto size = static_cast<GLsizei>(colors.size());
    gl.TextureStorage1D(texture.name(), 1, GL_RGB16F, size);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl.TextureSubImage1D(texture.name(), 0, 0, size, GL_RGB, GL_FLOAT, colors.data());
    gl.TextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
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
