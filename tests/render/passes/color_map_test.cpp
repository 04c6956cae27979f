// Color maps: lightness changes in one direction, and steps look equal.
#include "render/passes/color_map.h"

#include "render/gl/srgb.h"
#include "render/passes/cielab.h"
#include "tests/support/test_seed.h"

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

constexpr std::array kAllMaps{ColorMap::dusk, ColorMap::lagoon, ColorMap::polar, ColorMap::gray};

TEST(ColorMaps, GrowLighterAllTheWayOrUpToTheMiddle) {
    for (const ColorMap map : kAllMaps) {
        const auto lab = in_lab(map);
        ASSERT_EQ(lab.size(), kColorMapSize);
        for (std::size_t i = 1; i < lab.size(); ++i) {
            const bool rising = map != ColorMap::polar || i < lab.size() / 2;
            if (map == ColorMap::polar && i == lab.size() / 2)
                continue; // the two ends of the middle are alike
            EXPECT_EQ(lab[i].x > lab[i - 1].x, rising) << int(map) << ' ' << i;
        }
        EXPECT_GT(std::abs(lab[lab.size() / 2].x - lab.front().x), 25) << int(map);
    }
}

TEST(ColorMaps, StandOutFromADarkBackgroundAndAreNeverWhite) {
    for (const ColorMap map : kAllMaps)
        for (const glm::vec3& lab : in_lab(map)) {
            EXPECT_GE(lab.x, 30.0f) << int(map);
            EXPECT_LE(lab.x, 97.0f) << int(map);
        }
}

TEST(ColorMaps, StepThroughEqualDifferencesOfColor) {
    for (const ColorMap map : kAllMaps) {
        const auto lab = in_lab(map);
        std::vector<float> steps;
        for (std::size_t i = 1; i < lab.size(); ++i)
            if (map != ColorMap::polar || i != lab.size() / 2) // there the curve turns
                steps.push_back(color_difference(lab[i - 1], lab[i]));
        const auto [least, most] = std::ranges::minmax(steps);
        EXPECT_LT(most / least, 1.2f) << int(map) << ": " << least << " to " << most;
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

TEST(ColorMaps, AreFoundByTheirNames) {
    for (std::size_t i = 0; i < kColorMapNames.size(); ++i)
        EXPECT_EQ(color_map_from_name(kColorMapNames[i]), static_cast<ColorMap>(i));
    EXPECT_FALSE(color_map_from_name("rainbow"));
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
