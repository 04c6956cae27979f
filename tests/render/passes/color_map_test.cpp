// Color maps: lightness changes in one direction, and steps look equal.
#include "render/passes/color_map.h"

#include "render/gl/srgb.h"
#include "render/passes/cielab.h"
#include "tests/support/test_seed.h"

#include <cmath>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace isochron::render {
namespace {

std::vector<glm::vec3> in_lab(ColorMap map) {
    std::vector<glm::vec3> lab;
    for (const glm::vec3& color : color_map(map))
        lab.push_back(cielab_from_linear(color));
    return lab;
}

constexpr std::array kAllMaps{ColorMap::viridis,  ColorMap::inferno, ColorMap::cividis,
                              ColorMap::coolwarm, ColorMap::turbo,   ColorMap::gray,
                              ColorMap::grayscale};
bool turns_back(ColorMap map) {
    return map == ColorMap::coolwarm || map == ColorMap::turbo;
}

TEST(ColorMaps, GrowLighterAllTheWayOrUpToOnePlace) {
    for (const ColorMap map : kAllMaps) {
        const auto lab = in_lab(map);
        ASSERT_EQ(lab.size(), kColorMapSize);
        const auto lightest =
            std::ranges::max_element(lab, {}, [](const glm::vec3& c) { return c.x; }) - lab.begin();
        if (turns_back(map))
            EXPECT_NEAR(double(lightest), 0.5 * double(lab.size()), 0.1 * double(lab.size()))
                << name_of(map);
        else
            EXPECT_EQ(lightest, std::ptrdiff_t(lab.size()) - 1) << name_of(map);
        constexpr float kRounding = 0.02f; // rounding of published eight-bit colors
        for (std::ptrdiff_t i = 1; i < std::ptrdiff_t(lab.size()); ++i)
            EXPECT_GT((lab[i].x - lab[i - 1].x) * (i <= lightest ? 1.0f : -1.0f), -kRounding)
                << name_of(map) << ' ' << i;
        EXPECT_GT(lab[lightest].x - lab.front().x, 25) << name_of(map);
    }
}

TEST(ColorMaps, StepThroughDifferencesOfColorThatAreAlike) {
    for (const ColorMap map : kAllMaps) {
        const auto lab = in_lab(map);
        float whole = 0;
        for (std::size_t i = 1; i < lab.size(); ++i)
            whole += color_difference(lab[i - 1], lab[i]);
        // A sixteenth of the map is a twentieth to an eighth of all difference; a rainbow's is not.
        const float most = map == ColorMap::turbo ? 0.17f : 0.125f;
        const float least = map == ColorMap::turbo || map == ColorMap::inferno ? 0.02f : 0.035f;
        for (std::size_t first = 0; first + 16 < lab.size(); first += 16) {
            float part = 0;
            for (std::size_t i = first; i < first + 16; ++i)
                part += color_difference(lab[i], lab[i + 1]);
            EXPECT_LT(part, most * whole) << name_of(map) << ' ' << first;
            EXPECT_GT(part, least * whole) << name_of(map) << ' ' << first;
        }
    }
}

TEST(ColorMaps, HaveThePublishedColors) {
    struct Known {
        ColorMap map;
        double share;
        std::array<int, 3> rgb;
    };
    // Entries of the tables of Matplotlib's _cm_listed.py, and of coolwarm in its _cm.py.
    for (const Known& known : {Known{ColorMap::viridis, 0 / 255.0, {68, 1, 84}},
                               {ColorMap::viridis, 40 / 255.0, {69, 55, 129}},
                               {ColorMap::viridis, 85 / 255.0, {49, 104, 142}},
                               {ColorMap::viridis, 127 / 255.0, {33, 144, 141}},
                               {ColorMap::viridis, 128 / 255.0, {33, 145, 140}},
                               {ColorMap::viridis, 170 / 255.0, {53, 183, 121}},
                               {ColorMap::viridis, 215 / 255.0, {149, 216, 64}},
                               {ColorMap::viridis, 255 / 255.0, {253, 231, 37}},
                               {ColorMap::inferno, 0 / 255.0, {0, 0, 4}},
                               {ColorMap::inferno, 40 / 255.0, {47, 10, 91}},
                               {ColorMap::inferno, 85 / 255.0, {120, 28, 109}},
                               {ColorMap::inferno, 127 / 255.0, {186, 54, 85}},
                               {ColorMap::inferno, 128 / 255.0, {188, 55, 84}},
                               {ColorMap::inferno, 170 / 255.0, {237, 105, 37}},
                               {ColorMap::inferno, 215 / 255.0, {251, 186, 31}},
                               {ColorMap::inferno, 255 / 255.0, {252, 255, 164}},
                               {ColorMap::cividis, 0 / 255.0, {0, 34, 78}},
                               {ColorMap::cividis, 40 / 255.0, {39, 62, 110}},
                               {ColorMap::cividis, 85 / 255.0, {87, 93, 109}},
                               {ColorMap::cividis, 127 / 255.0, {124, 123, 120}},
                               {ColorMap::cividis, 128 / 255.0, {125, 124, 120}},
                               {ColorMap::cividis, 170 / 255.0, {165, 156, 116}},
                               {ColorMap::cividis, 215 / 255.0, {212, 193, 95}},
                               {ColorMap::cividis, 255 / 255.0, {254, 232, 56}},
                               {ColorMap::turbo, 0 / 255.0, {48, 18, 59}},
                               {ColorMap::turbo, 40 / 255.0, {70, 128, 246}},
                               {ColorMap::turbo, 85 / 255.0, {26, 228, 182}},
                               {ColorMap::turbo, 127 / 255.0, {161, 253, 61}},
                               {ColorMap::turbo, 128 / 255.0, {164, 252, 60}},
                               {ColorMap::turbo, 170 / 255.0, {250, 186, 57}},
                               {ColorMap::turbo, 215 / 255.0, {225, 65, 9}},
                               {ColorMap::turbo, 255 / 255.0, {122, 4, 3}},
                               {ColorMap::grayscale, 0, {0, 0, 0}}, // `gray` in its _cm.py
                               {ColorMap::grayscale, 0.25, {64, 64, 64}},
                               {ColorMap::grayscale, 0.5, {128, 128, 128}},
                               {ColorMap::grayscale, 1, {255, 255, 255}},
                               {ColorMap::coolwarm, 0, {59, 76, 192}},
                               {ColorMap::coolwarm, 0.125, {98, 130, 234}},
                               {ColorMap::coolwarm, 0.25, {141, 176, 254}},
                               {ColorMap::coolwarm, 0.375, {184, 208, 249}},
                               {ColorMap::coolwarm, 0.5, {221, 221, 221}},
                               {ColorMap::coolwarm, 0.625, {245, 196, 173}},
                               {ColorMap::coolwarm, 0.75, {244, 154, 123}},
                               {ColorMap::coolwarm, 0.875, {222, 96, 77}},
                               {ColorMap::coolwarm, 1, {180, 4, 38}}}) {
        const auto colors = color_map(known.map);
        const double at = known.share * double(colors.size() - 1);
        const glm::vec3 light =
            glm::mix(colors[std::size_t(at)], colors[std::size_t(std::lround(at))], 0.5f);
        const glm::vec3 shown = 255.0f * srgb_from_linear(light);
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(shown[channel], known.rgb[std::size_t(channel)], 2.5)
                << name_of(known.map) << ' ' << known.share << ' ' << channel;
    }
}

TEST(ColorMaps, AreWithinWhatADisplayShows) {
    for (const ColorMap map : kAllMaps)
        for (const glm::vec3& color : color_map(map))
            for (int channel = 0; channel < 3; ++channel) {
                EXPECT_GE(color[channel], 0.0f);
                EXPECT_LE(color[channel], 1.0f);
            }
}

TEST(ColorMaps, AreFoundByTheirNamesOldOnesToo) {
    for (std::size_t i = 0; i < kColorMapNames.size(); ++i)
        EXPECT_EQ(color_map_from_name(kColorMapNames[i]), static_cast<ColorMap>(i));
    EXPECT_EQ(color_map_from_name("lagoon"), ColorMap::viridis);
    EXPECT_EQ(color_map_from_name("dusk"), ColorMap::inferno);
    EXPECT_EQ(color_map_from_name("polar"), ColorMap::coolwarm);
    EXPECT_EQ(color_map_from_name("grey"), ColorMap::gray);
    EXPECT_FALSE(color_map_from_name("rainbow"));
}

TEST(ColorMaps, GrayStaysLiftedAndIsShownAsThat) {
    const auto lab = in_lab(ColorMap::gray);
    EXPECT_NEAR(lab.front().x, 32, 0.1);
    EXPECT_NEAR(lab.back().x, 96, 0.1);
    EXPECT_EQ(shown_name_of(ColorMap::gray), "gray, lifted");
    EXPECT_EQ(name_of(ColorMap::gray), "gray");
    EXPECT_EQ(shown_name_of(ColorMap::grayscale), "grayscale");
}

TEST(ColorMaps, MayBeReversedAndInBands) {
    const auto map = color_map(ColorMap::viridis);
    auto reversed = used(map, {.reversed = true});
    std::ranges::reverse(reversed);
    EXPECT_EQ(reversed, map);
    for (const std::uint32_t bands : {1u, 2u, 3u, 7u, 64u}) {
        const auto parts = used(map, {.bands = bands});
        ASSERT_EQ(parts.size(), map.size());
        std::size_t colors = 1;
        for (std::size_t i = 1; i < parts.size(); ++i)
            colors += parts[i] != parts[i - 1];
        EXPECT_EQ(colors, bands);
        if (bands > 1) {
            EXPECT_EQ(parts.front(), map.front());
            EXPECT_EQ(parts.back(), map.back());
        }
    }
}

TEST(CieLab, KnowsWhiteBlackAndTheRedPrimary) {
    const glm::vec3 white = cielab_from_linear(glm::vec3(1.0f));
    EXPECT_NEAR(white.x, 100, 1e-2);
    EXPECT_NEAR(white.y, 0, 1e-2);
    EXPECT_NEAR(white.z, 0, 1e-2);
    EXPECT_NEAR(cielab_from_linear(glm::vec3(0.0f)).x, 0, 1e-3);
    const glm::vec3 red = cielab_from_linear({1, 0, 0}); // 53.24, 80.09, 67.20 in the literature
    EXPECT_NEAR(red.x, 53.24, 0.1);
    EXPECT_NEAR(red.y, 80.09, 0.2);
    EXPECT_NEAR(red.z, 67.20, 0.2);
}

TEST(CieLab, GoesThereAndBack) {
    std::mt19937 random(test_seed());
    std::uniform_real_distribution<float> share(0.0f, 1.0f);
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 light(share(random), share(random), share(random));
        const glm::vec3 back = linear_from_cielab(cielab_from_linear(light));
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(back[channel], light[channel], 1e-4);
    }
}

TEST(Srgb, FollowsItsStandardAndGoesThereAndBack) {
    EXPECT_NEAR(linear_from_srgb(0.5f), 0.2140f, 1e-4);
    EXPECT_NEAR(srgb_from_linear(0.5f), 0.7354f, 1e-4);
    for (int byte = 0; byte < 256; ++byte) {
        const float value = static_cast<float>(byte) / 255.0f;
        EXPECT_NEAR(srgb_from_linear(linear_from_srgb(value)), value, 1e-5);
    }
}

TEST(SurfacePalette, KeepsSurfacesApart) {
    const auto& palette = surface_palette();
    for (std::size_t a = 0; a < palette.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            EXPECT_GT(color_difference(cielab_from_linear(linear_from_srgb(palette[a])),
                                       cielab_from_linear(linear_from_srgb(palette[b]))),
                      20)
                << a << ' ' << b;
}

} // namespace
} // namespace isochron::render
