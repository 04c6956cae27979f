// Viewers, windows, viewports and screens in TOML: read, refused with their place, and written.
#include "app/config/check_config.h"
#include "app/config/config.h"
#include "app/config/display_config_text.h"
#include "app/config/shipped_configs.h"
#include "tests/app/config/config_error.h"
#include "tests/support/test_seed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace isochron::app {
namespace {

using testing::HasSubstr;

const std::string kTwoViewers = R"(
[[viewers]]
name = "guide"
head = "glasses 1"
position = [0, 1.8, 0]
[[viewers]]
name = "guest"
head = "glasses 2"
eye_separation = 0.058
[[windows]]
name = "wall"
stereo = "checkerboard_inverted"
position = [-1920, 5]
border = false
[[windows.viewports]]
name = "upper"
position = [0, 0.5]
size = [1, 0.5]
viewer = "guest"
[windows.viewports.projection]
carried_by = "head"
lower_left = [-1, -1, -1]
upper_left = [-1, 1, -1]
upper_right = [1, 1, -1]
[[windows.viewports]]
size = [1, 0.5]
[[windows]]
)";

TEST(DisplayConfig, ViewersWindowsAndViewportsArrive) {
    const Config config = parse_config(kTwoViewers, "lab.toml");
    const stereo::Installation& lab = config.installation;
    ASSERT_EQ(lab.viewers.size(), 2u);
    EXPECT_EQ(lab.viewers[0].head, "glasses 1");
    EXPECT_EQ(lab.viewers[0].position, glm::vec3(0, 1.8f, 0));
    EXPECT_EQ(lab.viewers[1].eye_separation, 0.058f);
    EXPECT_EQ(config.emulation.head.position, glm::vec3(0, 1.8f, 0));
    ASSERT_EQ(lab.windows.size(), 2u);
    EXPECT_EQ(lab.windows[0].stereo, stereo::inverted(stereo::StereoMode::checkerboard));
    EXPECT_EQ(lab.windows[0].position, glm::ivec2(-1920, 5));
    EXPECT_FALSE(lab.windows[0].border);
    ASSERT_EQ(lab.windows[0].viewports.size(), 2u);
    EXPECT_EQ(lab.windows[0].viewports[0].viewer, 1u);
    EXPECT_TRUE(lab.windows[0].viewports[0].screen.carried_by_head);
    EXPECT_EQ(lab.windows[0].viewports[1].viewer, 0u);
    EXPECT_EQ(lab.windows[1].name, "window 2");
    EXPECT_EQ(lab.viewers[0].line.number, 2);
    EXPECT_EQ(lab.viewers[1].line.number, 6);
    EXPECT_EQ(lab.windows[0].line.number, 10);
    EXPECT_EQ(lab.windows[0].viewports[0].screen.line.number, 20);
    EXPECT_EQ(lab.windows[0].viewports[1].screen.line.number, 25);
}

TEST(DisplayConfig, WhatDoesNotFitTogetherIsRefusedWithItsPlace) {
    EXPECT_EQ(error_of("[viewer]\n[[viewers]]\n"),
              "lab.toml:2: viewers: [viewer] describes the one viewer already");
    EXPECT_EQ(error_of("[[viewers]]\nname = \"a\"\n[[viewers]]\nname = \"a\"\n"),
              "lab.toml:4: viewers.name: two viewers are called 'a'");
    EXPECT_EQ(error_of("[[windows]]\nname = \"a\"\n[[windows]]\nname = \"a\"\n"),
              "lab.toml:4: windows.name: two windows are called 'a'");
    EXPECT_EQ(error_of("[[windows]]\nname = \"\"\n"),
              "lab.toml:2: windows.name: a window needs a name");
    EXPECT_THAT(error_of("[[windows]]\n[[windows.viewports]]\nviewer = \"viewr\"\n"),
                HasSubstr("lab.toml:3: windows.viewports.viewer: unknown value 'viewr', expected "
                          "one of viewer; did you mean 'viewer'?"));
    EXPECT_THAT(error_of("[[windows]]\n[[windows.viewports]]\n[windows.viewports.projection]\n"
                         "lower_left = [0,0,0]\nupper_left = [0,1,0]\nupper_right = [0,2,0]\n"),
                HasSubstr("lab.toml:6: windows.viewports.projection.upper_right: the three "
                          "corners lie on one line"));
    EXPECT_THAT(error_of("[[viewers]]\nhaed = \"x\"\n"), HasSubstr("did you mean 'head'?"));
}

TEST(DisplayConfig, EveryStereoWordIsRead) {
    for (const std::string_view word : stereo::stereo_mode_words())
        EXPECT_EQ(parse_config("[[windows]]\nstereo = \"" + std::string(word) + "\"\n", "lab.toml")
                      .installation.windows[0]
                      .stereo,
                  stereo::stereo_mode_from_name(word));
}

/// An installation in which everything is at random.
stereo::Installation any_installation(std::mt19937& random) {
    const auto number = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    const auto whole = [&](int low, int high) {
        return std::uniform_int_distribution<int>(low, high)(random);
    };
    const auto point = [&] { return glm::vec3(number(-9, 9), number(-9, 9), number(-9, 9)); };
    const auto modes = stereo::all_stereo_modes();
    stereo::Installation lab;
    lab.viewers.clear();
    for (int i = whole(1, 3); i > 0; --i)
        lab.viewers.push_back({.name = "viewer \"" + std::to_string(i) + "\"\t\\",
                               .head = "head" + std::to_string(i),
                               .position = point(),
                               .eye_separation = number(0, 0.1f)});
    for (stereo::Viewer& viewer : lab.viewers)
        if (whole(0, 1) == 1) {
            viewer.left_eye = {number(-0.04f, 0), number(-0.01f, 0.01f), number(-0.1f, 0.1f)};
            viewer.right_eye = *viewer.left_eye + glm::vec3(number(0, 0.05f), number(0, 0.01f), 0);
            viewer.eye_separation = glm::length(*viewer.right_eye - *viewer.left_eye);
        }
    lab.windows.clear();
    for (int i = whole(1, 4); i > 0; --i) {
        stereo::Window window;
        window.name = "Wand\n\x7f Süd " + std::to_string(i);
        window.size = {whole(16, 16384), whole(16, 16384)};
        window.position = {whole(-65536, 65536), whole(-65536, 65536)};
        window.fullscreen = whole(0, 1);
        window.border = whole(0, 1);
        window.monitor = whole(0, 63);
        window.node = whole(0, 255);
        window.stereo = modes[whole(0, static_cast<int>(modes.size()) - 1)];
        window.viewports.clear();
        for (int v = whole(1, 3); v > 0; --v) {
            stereo::Viewport viewport;
            viewport.name = v == 1 ? "" : "part " + std::to_string(v);
            viewport.position = {number(0, 0.5f), number(0, 0.5f)};
            viewport.size = {number(0.01f, 0.5f), number(0.01f, 0.5f)};
            viewport.upside_down = whole(0, 1) == 1;
            viewport.viewer = whole(0, static_cast<int>(lab.viewers.size()) - 1);
            viewport.screen = {point(),          point(),         point(),
                               whole(0, 1) == 1, number(0, 0.5f), whole(0, 1) == 1};
            window.viewports.push_back(viewport);
        }
        lab.windows.push_back(window);
    }
    lab.near_plane = number(0.01f, 1);
    lab.far_plane = number(2, 100);
    return lab;
}

std::string error_of_viewer(const std::string& keys) {
    try {
        parse_config("[viewer]\n" + keys, "lab.toml");
    } catch (const ConfigError& error) {
        return error.what();
    }
    return "no error";
}

TEST(DisplayConfig, EyesThatLieUnlikeOnBothSidesAreBothGivenOrNone) {
    const Config config = parse_config(
        "[viewer]\nleft_eye = [-0.033, 0, -0.02]\nright_eye = [0.03, 0, -0.02]\n", "lab.toml");
    const stereo::Viewer& viewer = config.installation.viewers.front();
    EXPECT_FLOAT_EQ(viewer.eye_separation, 0.063f);
    const stereo::Eyes eyes = stereo::eyes_of_viewer(viewer, viewer.eye_separation);
    EXPECT_NEAR(eyes.middle.x, -0.0015f, 1e-7f);
    EXPECT_FLOAT_EQ(eyes.middle.z, -0.02f);
    EXPECT_THAT(describe(config), HasSubstr("eyes 63.0 mm apart around -1.5 0.0 -20.0 mm"));
    EXPECT_THAT(error_of_viewer("left_eye = [-0.033, 0, 0]\n"),
                HasSubstr("viewer.right_eye: missing, both eyes are given or none"));
    EXPECT_THAT(error_of_viewer("right_eye = [0.033, 0, 0]\n"),
                HasSubstr("viewer.left_eye: missing"));
    const std::string right = "right_eye = [0.03, 0, 0]\n";
    EXPECT_THAT(error_of_viewer("eye_separation = 0.06\nleft_eye = [-0.03, 0, 0]\n" + right),
                HasSubstr("lab.toml:2: viewer.eye_separation: left_eye and right_eye say"));
    EXPECT_THAT(error_of_viewer("left_eye = [-33, 0, 0]\n" + right),
                HasSubstr("viewer.left_eye: the eye is 33 m from the head, expected at most 0.5"));
    EXPECT_THAT(error_of_viewer("left_eye = [-0.09, 0, 0]\n" + right),
                HasSubstr("viewer.right_eye: the eyes are 0.12 m apart, expected at most 0.1"));
    EXPECT_THAT(error_of_viewer("left_eye = [0.05, 0, 0]\n" + right),
                HasSubstr("viewer.left_eye: the left eye is right of the right one"));
    EXPECT_THAT(error_of_viewer("left_eye = [nan, 0, 0]\n" + right), HasSubstr("lab.toml:2"));
}

TEST(DisplayConfig, WhatIsWrittenReadsAsTheSameInstallation) {
    std::mt19937 random(test_seed());
    for (int i = 0; i < 200; ++i) {
        const stereo::Installation lab = any_installation(random);
        const std::string text = display_config_text(lab);
        EXPECT_EQ(parse_config(text, "written.toml").installation, lab) << text;
    }
    for (const std::string& name : shipped_config_names()) {
        const stereo::Installation shipped = read_config(name).installation;
        EXPECT_EQ(parse_config(display_config_text(shipped), name).installation, shipped) << name;
    }
}

} // namespace
} // namespace isochron::app
