// The scale bar shows the right length at the data's center.
#include "app/scene/orientation.h"

#include "interaction/navigation/navigation.h"
#include "stereo/screen.h"
#include "tests/support/test_seed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace isochron::app {
namespace {

TEST(ScaleBar, IsARoundLengthAsLongAsItIsSeenAtTheCenter) {
    std::mt19937 random(test_seed());
    std::uniform_real_distribution<double> unit(-1, 1);
    stereo::Screen screen;
    screen.lower_left = {-0.5f, -0.5f, -1.2f};
    screen.upper_left = {-0.5f, 0.5f, -1.2f};
    screen.upper_right = {0.5f, 0.5f, -1.2f};
    screen.carried_by_head = true;
    const interaction::Pose head{{0, 1.6f, 0}, {1, 0, 0, 0}};
    const glm::ivec2 size(900, 900);
    const glm::dvec3 center(12, -3, 7);
    for (int i = 0; i < 300; ++i) {
        interaction::Similarity volume{
            {0, 0, 0},
            glm::normalize(glm::dquat(unit(random), unit(random), unit(random), unit(random))),
            std::pow(10.0, 3 * unit(random))};
        volume.translation = glm::dvec3(0.3 * unit(random), 1.6, -2 + unit(random)) -
                             interaction::transform(volume, center);
        for (const bool parallel : {false, true}) {
            const render::View view =
                parallel ? stereo::parallel_view_of(screen, head, 1.5f, 50.0f, size)
                         : stereo::view_of(screen, head, stereo::Eye::center, 0, 0.05f, 50, size);
            const auto bar = scale_bar(view, volume, center);
            ASSERT_TRUE(bar);
            const double digits =
                bar->length / std::pow(10.0, std::floor(std::log10(bar->length * 1.0001)));
            EXPECT_TRUE(std::abs(digits - 1) < 1e-6 || std::abs(digits - 2) < 1e-6 ||
                        std::abs(digits - 5) < 1e-6)
                << bar->length;
            EXPECT_LE(bar->pixels, 180.01f);
            EXPECT_GT(bar->pixels, 180.0f / 2.6f);
            // Two places so far apart across the view are so many pixels apart.
            const glm::dvec3 at = interaction::transform(volume, center);
            const auto pixel = [&](const glm::dvec3& p) {
                const glm::vec4 clip =
                    view.clip_from_eye * view.eye_from_room * glm::vec4(glm::vec3(p), 1.0f);
                return 0.5 * (clip.x / clip.w + 1) * size.x;
            };
            const glm::dvec3 half(0.5 * bar->length * volume.scale, 0, 0);
            EXPECT_NEAR(pixel(at + half) - pixel(at - half), bar->pixels, 0.05);
        }
    }
}

TEST(ScaleBar, IsNoneWhereTheCenterIsBehindTheEye) {
    stereo::Screen screen;
    screen.carried_by_head = true;
    const interaction::Pose head{{0, 1.6f, 0}, {1, 0, 0, 0}};
    const render::View view =
        stereo::view_of(screen, head, stereo::Eye::center, 0, 0.05f, 50, {100, 100});
    EXPECT_FALSE(scale_bar(view, {{0, 1.6, 2}, {1, 0, 0, 0}, 1.0}, {0, 0, 0}));
}

} // namespace
} // namespace isochron::app
