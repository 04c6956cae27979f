// Several windows: each shows its own picture, all drawn in one context.
#include "stereo/windows.h"

#include "stereo/display.h"
#include "tests/stereo/each_eye.h"
#include "tests/support/eventually.h"
#include "tests/support/virtual_display.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <deque>
#include <functional>

namespace isochron::stereo {
namespace {

using Rgb = std::array<int, 3>;

Installation two_windows() {
    Installation installation;
    installation.windows.resize(2);
    installation.windows[0].name = "left wall";
    installation.windows[0].size = {300, 200};
    installation.windows[0].position = {10, 10};
    installation.windows[1].name = "right wall";
    installation.windows[1].size = {260, 240};
    installation.windows[1].position = {500, 300};
    installation.windows[1].border = false;
    return installation;
}

TEST(Windows, EachShowsItsOwnPictureThatOneContextDrew) {
    test_support::VirtualDisplay screen;
    const Installation installation = two_windows();
    const Windows windows = open_windows(ContextKind::glfw, installation, {.title = "lab"});
    ASSERT_EQ(windows.count(), 2u);
    EXPECT_EQ(&windows.drawing(), &windows[0]);
    EXPECT_EQ(windows[1].framebuffer_size(), glm::ivec2(260, 240));
    const render::Gl gl(windows.drawing().loader());
    std::deque<Display> displays;
    for (std::size_t i = 0; i < windows.count(); ++i)
        displays.emplace_back(gl, windows.drawing(), windows[i], installation.windows[i],
                              DisplayOptions{});
    const auto draw = [&](int green) {
        for (std::size_t i = 0; i < displays.size(); ++i)
            draw_each_eye(gl, displays[i], {}, 0.06f, StereoMode::side_by_side,
                          [&](const auto&, Eye eye) {
                              gl.ClearColor(i == 0, float(green), eye == Eye::right, 1);
                              gl.Clear(GL_COLOR_BUFFER_BIT);
                          });
        for (Display& display : displays)
            display.present();
    };
    for (const int green : {0, 1}) { // a second picture replaces the first in both
        const auto shows = [&](int x, int y, Rgb color) {
            return test_support::eventually([&] {
                windows.poll_events();
                draw(green);
                return screen.pixel(x, y) == color;
            });
        };
        EXPECT_TRUE(shows(10 + 20, 10 + 100, {255, 255 * green, 0}));
        EXPECT_TRUE(shows(10 + 280, 10 + 100, {255, 255 * green, 255}));
        EXPECT_TRUE(shows(500 + 20, 300 + 100, {0, 255 * green, 0}));
        EXPECT_TRUE(shows(500 + 240, 300 + 100, {0, 255 * green, 255}));
    }
    EXPECT_EQ(gl.GetError(), GLenum{GL_NO_ERROR});
    screen.close_window("lab: right wall");
    EXPECT_TRUE(test_support::eventually([&] {
        windows.poll_events();
        return windows.should_close();
    }));
}

TEST(Windows, WithoutAQuadBufferedVisualTheErrorIsOneLineThatSaysWhatToDo) {
    test_support::VirtualDisplay screen;
    Installation installation = two_windows();
    installation.windows[0].stereo = StereoMode::quadbuffer;
    try {
        open_windows(ContextKind::glfw, installation, {.stereo = StereoMode::quadbuffer});
        FAIL() << "the software renderer offers no such visual";
    } catch (const render::Error& error) {
        EXPECT_THAT(error.what(), testing::StartsWith("window left wall: context glfw: "));
        EXPECT_THAT(error.what(), testing::HasSubstr("a left and a right buffer"));
        EXPECT_THAT(error.what(), testing::HasSubstr("--emulate"));
        EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
    }
    // Another mode, and the same windows open.
    EXPECT_EQ(
        open_windows(ContextKind::glfw, installation, {.stereo = StereoMode::top_bottom}).count(),
        2u);
}

class OffscreenWindows : public testing::TestWithParam<ContextKind> {};

TEST_P(OffscreenWindows, ArePicturesOfTheirOwnSizesInOneContext) {
    Installation installation = two_windows();
    installation.windows[1].stereo = StereoMode::quadbuffer;
    const Windows windows = open_windows(GetParam(), installation, {});
    ASSERT_EQ(windows.count(), 2u);
    EXPECT_EQ(windows[0].framebuffer_size(), glm::ivec2(300, 200));
    EXPECT_EQ(windows[1].framebuffer_size(), glm::ivec2(260, 240));
    EXPECT_EQ(windows.room(), nullptr);
    EXPECT_FALSE(windows.should_close());
    const Windows room = open_room(GetParam(), installation, {.size = {400, 100}});
    ASSERT_NE(room.room(), nullptr);
    EXPECT_EQ(room.room()->framebuffer_size(), glm::ivec2(400, 100));
    EXPECT_EQ(room[1].framebuffer_size(), glm::ivec2(260, 240));
}

INSTANTIATE_TEST_SUITE_P(, OffscreenWindows, testing::Values(ContextKind::egl, ContextKind::osmesa),
                         [](const auto& kind) { return std::string(name_of(kind.param)); });

TEST(WindowSize, SuitsTheScaleOfTheDesktopAndFitsTheMonitor) {
    EXPECT_EQ(size_on_desktop({1280, 720}, 1, {1920, 1080}), glm::ivec2(1280, 720));
    EXPECT_EQ(size_on_desktop({1280, 720}, 2, {3840, 2160}), glm::ivec2(2560, 1440));
    EXPECT_EQ(size_on_desktop({1280, 720}, 2, {0, 0}), glm::ivec2(2560, 1440)) << "no monitor";
    EXPECT_EQ(size_on_desktop({1280, 720}, 2, {2560, 1440}), glm::ivec2(2544, 1376));
    EXPECT_EQ(size_on_desktop({3000, 600}, 1, {1280, 720}), glm::ivec2(1272, 600));
}

} // namespace
} // namespace isochron::stereo
