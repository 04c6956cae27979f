// Color maps from curves in CIE L*a*b*.
#include "render/passes/color_map.h"

#include "render/passes/cielab.h"

#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace isochron::render {
namespace {

/// A curve through L*a*b* in cylindrical coordinates, linear in lightness and hue.
struct Curve {
    float lightness_low, lightness_high;
    float hue_low, hue_high; ///< degrees
    float chroma;            ///< most chroma; less if a display cannot show it
    float fades_from;        ///< from here (0 to 1) to the light end, chroma decreases to 0
};
// No map starts darker than this: shading darkens a surface further, and on a dark background the
// shape and hue of the low end would be lost.
constexpr float kDarkest = 32;
constexpr Curve kDusk{kDarkest, 94, 303, 455, 60, 0.65f};
constexpr Curve kLagoon{kDarkest, 93, 300, 108, 50, 0.65f};
constexpr Curve kColdHalf{kDarkest, 88, 280, 265, 60, 0};
constexpr Curve kWarmHalf{kDarkest, 88, 30, 50, 60, 0};
constexpr Curve kGray{kDarkest, 96, 0, 0, 0, 0};

constexpr int kFine = 4096; ///< steps of a curve before it is divided evenly

bool shown(const glm::vec3& light) {
    constexpr float kRounding = 1e-4f;
    return glm::all(glm::greaterThanEqual(light, glm::vec3(-kRounding))) &&
           glm::all(glm::lessThanEqual(light, glm::vec3(1.0f + kRounding)));
}

glm::vec3 lab(float lightness, float chroma, float hue) {
    return {lightness, chroma * std::cos(glm::radians(hue)), chroma * std::sin(glm::radians(hue))};
}

/// A point of the curve, with less chroma if a display cannot show it.
glm::vec3 point(const Curve& curve, float t) {
    const float lightness = glm::mix(curve.lightness_low, curve.lightness_high, t);
    const float hue = glm::mix(curve.hue_low, curve.hue_high, t);
    const float faded = std::max(t - curve.fades_from, 0.0f) / (1.0f - curve.fades_from);
    const float wanted = curve.chroma * (1.0f - faded * faded);
    if (shown(linear_from_cielab(lab(lightness, wanted, hue))))
        return lab(lightness, wanted, hue);
    float low = 0.0f, high = wanted;
    for (int halving = 0; halving < 24; ++halving) {
        const float middle = 0.5f * (low + high);
        (shown(linear_from_cielab(lab(lightness, middle, hue))) ? low : high) = middle;
    }
    return lab(lightness, low, hue);
}

/// Places on the polyline at equal distances along it.
std::vector<glm::vec3> evenly(const std::vector<glm::vec3>& fine, std::size_t count) {
    std::vector<float> reached{0.0f};
    for (std::size_t i = 1; i < fine.size(); ++i)
        reached.push_back(reached.back() + color_difference(fine[i - 1], fine[i]));
    std::vector<glm::vec3> result;
    for (std::size_t k = 0; k < count; ++k) {
        const float wanted = reached.back() * static_cast<float>(k) / static_cast<float>(count - 1);
        const auto next =
            std::clamp<std::ptrdiff_t>(std::ranges::lower_bound(reached, wanted) - reached.begin(),
                                       1, static_cast<std::ptrdiff_t>(fine.size()) - 1);
        const float from = reached[next - 1], to = reached[next];
        result.push_back(
            glm::mix(fine[next - 1], fine[next], to > from ? (wanted - from) / (to - from) : 0.0f));
    }
    return result;
}

void append(std::vector<glm::vec3>& fine, const Curve& curve, bool backwards = false) {
    for (int i = 0; i <= kFine; ++i) {
        const float t = static_cast<float>(i) / kFine;
        fine.push_back(point(curve, backwards ? 1.0f - t : t));
    }
}

} // namespace

std::optional<ColorMap> color_map_from_name(std::string_view name) {
    if (name == "grey") // as recordings of version 0.1 spell it
        return ColorMap::gray;
    const auto found = std::ranges::find(kColorMapNames, name);
    if (found == kColorMapNames.end())
        return std::nullopt;
    return static_cast<ColorMap>(found - kColorMapNames.begin());
}

std::vector<glm::vec3> color_map(ColorMap map) {
    std::vector<glm::vec3> fine;
    switch (map) {
    case ColorMap::dusk: append(fine, kDusk); break;
    case ColorMap::lagoon: append(fine, kLagoon); break;
    case ColorMap::polar:
        append(fine, kColdHalf);
        append(fine, kWarmHalf, true);
        break;
    case ColorMap::gray: append(fine, kGray); break;
    }
    std::vector<glm::vec3> colors = evenly(fine, kColorMapSize);
    for (glm::vec3& color : colors)
        color = glm::clamp(linear_from_cielab(color), 0.0f, 1.0f);
    return colors;
}

Texture color_map_texture(const Gl& gl, ColorMap map) {
    Texture texture(gl, GL_TEXTURE_1D);
    const std::vector<glm::vec3> colors = color_map(map);
    gl.TextureStorage1D(texture.name(), 1, GL_RGB16F, kColorMapSize);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl.TextureSubImage1D(texture.name(), 0, 0, kColorMapSize, GL_RGB, GL_FLOAT, colors.data());
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
