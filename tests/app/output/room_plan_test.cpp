// The figure of a configuration: to scale, and red where something is wrong.
#include "app/output/room_plan.h"

#include "app/config/check_config.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>

namespace isochron::app {
namespace {

using Color = std::array<int, 3>;
constexpr Color kSoundWall{33, 77, 148}, kWrongWall{209, 18, 26}, kOddWall{204, 120, 0};

render::Image figure_of(const std::string& text) {
    const Config config = parse_config(text, "lab.toml");
    return room_plan(config, problems_of(config));
}

std::string wall(const std::string& corners, double width = 2) {
    return fmt::format("[[windows]]\nname = \"a\"\nsize = [{:.0f}, 1000]\n"
                       "[[windows.viewports]]\n[windows.viewports.projection]\n{}",
                       500 * width, corners);
}

struct Extent {
    int pixels = 0, low_x = 1 << 20, high_x = -1, low_y = 1 << 20, high_y = -1;
};
/// Where a color is, in a part of the picture.
Extent extent_of(const render::Image& image, const Color& color, int left, int top, int right,
                 int bottom) {
    Extent found;
    for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x) {
            const std::uint8_t* pixel = image.at(x, y);
            if (pixel[0] != color[0] || pixel[1] != color[1] || pixel[2] != color[2])
                continue;
            ++found.pixels;
            found.low_x = std::min(found.low_x, x);
            found.high_x = std::max(found.high_x, x);
            found.low_y = std::min(found.low_y, y);
            found.high_y = std::max(found.high_y, y);
        }
    return found;
}
/// In the two views at the top, above the legend.
Extent in_views(const render::Image& image, const Color& color) {
    return extent_of(image, color, 0, 0, image.width, image.height / 2);
}

TEST(RoomPlan, AWallThatFacesAwayIsRed) {
    const std::string right = "lower_left = [-1, 1, -1]\nupper_left = [-1, 3, -1]\n"
                              "upper_right = [1, 3, -1]\n",
                      inverted = "lower_left = [1, 1, -1]\nupper_left = [1, 3, -1]\n"
                                 "upper_right = [-1, 3, -1]\n";
    EXPECT_EQ(in_views(figure_of(wall(right)), kWrongWall).pixels, 0);
    EXPECT_GT(in_views(figure_of(wall(right)), kSoundWall).pixels, 2000);
    EXPECT_GT(in_views(figure_of(wall(inverted)), kWrongWall).pixels, 2000);
}

TEST(RoomPlan, AWarningIsAmber) {
    const std::string wide = "lower_left = [-2, 1, -1]\nupper_left = [-2, 3, -1]\n"
                             "upper_right = [2, 3, -1]\n";
    EXPECT_GT(in_views(figure_of(wall(wide)), kOddWall).pixels, 2000);
}

TEST(RoomPlan, AllViewsHaveOneScale) {
    for (const double width : {2.0, 3.0}) {
        const render::Image image =
            figure_of(wall(fmt::format("lower_left = [-1, 0, -2]\nupper_left = [-1, 2, -2]\n"
                                       "upper_right = [{}, 2, -2]\n",
                                       width - 1),
                           width));
        const int half_x = image.width / 2, half_y = image.height / 2 + 17; // below the title
        const Extent behind = extent_of(image, kSoundWall, 0, half_y, half_x, image.height);
        const Extent above = extent_of(image, kSoundWall, 0, 0, half_x, half_y);
        ASSERT_GT(behind.pixels, 0);
        constexpr int kLine = 4; // pixels
        const double scale = (behind.high_y - behind.low_y - kLine) / 2.0;
        EXPECT_NEAR(behind.high_x - behind.low_x - kLine, scale * width, 4);
        EXPECT_NEAR(above.high_x - above.low_x - kLine, scale * width, 4);
        EXPECT_EQ(above.low_x, behind.low_x) << "one above the other";
    }
}

TEST(RoomPlan, DrawsWhateverCanBeRead) {
    for (const char* text :
         {"", "[viewer]\nposition = [0, 100000, 0]\n", "[placement]\nsize = 100\n",
          "[dtrack]\nscale = 1e6\nposition = [500, 0, 0]\n[[dtrack.devices]]\nname = \"head\"\n"
          "body = 0\n"}) {
        const render::Image image = figure_of(text);
        EXPECT_GT(image.width, 1000) << text;
        EXPECT_EQ(image.rgba.size(), std::size_t{4} * image.width * image.height);
    }
}

} // namespace
} // namespace isochron::app
