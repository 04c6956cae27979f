// `--check-config`: shipped configurations have no problems, and every problem is reported with its
// place.
#include "app/config/check_config.h"

#include "app/config/shipped_configs.h"
#include "tests/support/paths.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace isochron::app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> lines_of(const std::string& text) {
    const Config config = parse_config(text, "lab.toml");
    std::vector<std::string> lines;
    for (const ConfigProblem& problem : problems_of(config))
        lines.push_back(line_of(problem, config));
    return lines;
}

/// A window of 1000 x 1000 pixels with one screen.
std::string window_with(const std::string& corners, const std::string& window = "") {
    return "[[windows]]\nname = \"west\"\nsize = [1000, 1000]\n" + window +
           "[[windows.viewports]]\n[windows.viewports.projection]\n" + corners;
}
const std::string kSquare =
    "lower_left = [-1, 1, -1]\nupper_left = [-1, 3, -1]\nupper_right = [1, 3, -1]\n";

TEST(CheckConfig, EveryShippedConfigurationIsFoundByNameAndNothingIsWrongWithIt) {
    std::size_t files = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(test_support::source_root() + "/configs"))
        files += entry.path().extension() == ".toml";
    EXPECT_EQ(shipped_config_names().size(), files) << "one is not in app/CMakeLists.txt";
    for (const std::string& name : shipped_config_names()) {
        const Config config = read_config(name);
        for (const ConfigProblem& problem : problems_of(config))
            ADD_FAILURE() << line_of(problem, config);
        EXPECT_NO_THROW(
            check_config(read_config(test_support::source_root() + "/configs/" + name + ".toml")))
            << name;
    }
    EXPECT_THAT(shipped_config_names(),
                ElementsAre("cave4", "desk", "desktop", "headless", "hmd", "powerwall"));
}

TEST(CheckConfig, ScreensThatAreSkewedMirroredOrInMillimetersAreNamedWithFileLineAndKey) {
    EXPECT_THAT(lines_of(window_with("lower_left = [-1, 1, -1]\nupper_left = [-0.5, 3, -1]\n"
                                     "upper_right = [1.56, 3, -1]\n")),
                ElementsAre("lab.toml:5: windows.viewports.projection: window west: the corner at "
                            "upper_left has 104.0 degrees, expected 90"));
    EXPECT_THAT(lines_of(window_with("lower_left = [1, 1, -1]\nupper_left = [1, 3, -1]\n"
                                     "upper_right = [-1, 3, -1]\n")),
                ElementsAre(HasSubstr("lab.toml:5: windows.viewports.projection: window west: it "
                                      "is mirrored")));
    EXPECT_THAT(lines_of(window_with("lower_left = [-1000, 0, -1000]\n"
                                     "upper_left = [-1000, 2000, -1000]\n"
                                     "upper_right = [1000, 2000, -1000]\n")),
                testing::Contains(HasSubstr("2000 x 2000 m is no size of a screen")));
    // Carried by the head, corners count from the eyes, wherever the viewer stands.
    EXPECT_THAT(lines_of(window_with("carried_by = \"head\"\nlower_left = [-1, -1, -1]\n"
                                     "upper_left = [-1, 1, -1]\nupper_right = [1, 1, -1]\n")),
                IsEmpty());
}

TEST(CheckConfig, PixelsThatAreNotSquareAreWarnedOf) {
    const std::string wide =
        "lower_left = [-2, 1, -1]\nupper_left = [-2, 3, -1]\nupper_right = [2, 3, -1]\n";
    EXPECT_THAT(lines_of(window_with(wide)),
                ElementsAre("lab.toml:5: warning: windows.viewports.projection: window west: its "
                            "pixels are not square: 2.00 times as wide as high (1000 x 1000 pixels "
                            "on 4.00 x 2.00 m)"));
    EXPECT_THAT(lines_of(window_with(wide + "fit_aspect = true\n")), IsEmpty());
    // An eye's half may be stretched over the wall, or come from a projector of its own.
    EXPECT_THAT(lines_of(window_with(kSquare, "stereo = \"side_by_side\"\n")), IsEmpty());
    EXPECT_THAT(lines_of(window_with(wide, "stereo = \"top_bottom_inverted\"\n")), IsEmpty());
    EXPECT_THAT(lines_of(window_with(wide, "stereo = \"side_by_side\"\n")),
                ElementsAre(HasSubstr("not square")));
}

TEST(CheckConfig, WallsThatNearlyMeetAreWarnedOf) {
    const auto east = [](float gap) {
        return fmt::format("[[windows]]\nname = \"east\"\nsize = [1000, 1000]\n"
                           "[[windows.viewports]]\n[windows.viewports.projection]\n"
                           "lower_left = [{0}, 1, -1]\nupper_left = [{0}, 3, -1]\n"
                           "upper_right = [{0}, 3, 1]\n",
                           1.0f + gap);
    };
    EXPECT_THAT(lines_of(window_with(kSquare) + east(0.009f)), IsEmpty()) << "by a tape";
    EXPECT_THAT(lines_of(window_with(kSquare) + east(0.02f)),
                ElementsAre("lab.toml:13: warning: windows.viewports.projection: window east: a "
                            "corner is 20 mm from one of window west, where walls meet within "
                            "10 mm"));
    EXPECT_THAT(lines_of(window_with(kSquare) + east(0.5f)), IsEmpty()) << "walls apart";
}

TEST(CheckConfig, FramesOfTurnedMonitorsAreNoGap) {
    const auto monitor = [](const char* name, float edge) {
        return fmt::format("[[windows]]\nname = \"{}\"\nsize = [1920, 1200]\n"
                           "[[windows.viewports]]\n[windows.viewports.projection]\n"
                           "lower_left = [{}, 1, {}]\nupper_left = [{}, 1.375, {}]\n"
                           "upper_right = [{}, 1.375, {}]\n",
                           name, edge, -1.0f, edge, -1.0f, edge + (edge < 0 ? 0.6f : 0.48f),
                           edge < 0 ? -1.0f : -0.64f);
    };
    EXPECT_THAT(lines_of(monitor("left", -0.6f) + monitor("right", 0.05f)), IsEmpty());
    EXPECT_THAT(lines_of(monitor("left", -0.6f) + monitor("right", 0.08f)),
                ElementsAre(HasSubstr("a corner is 80 mm from one of window left")));
}

TEST(CheckConfig, TheDescriptionHoldsEveryPartAndItsMeasures) {
    const std::string text = describe(read_config("cave4"));
    for (const char* part :
         {"viewer guide: head head, at 0 1.7 0 m", "eyes 63.0 mm apart",
          "window floor: 1920 x 1200 pixels, fullscreen on the next monitor, quadbuffer",
          "node 0: the operator's window\nnode 1: front\nnode 2: left\n",
          "1200 x 1200 pixels at 360, 0; for guide",
          ("3.00 x 3.00 m, fixed in the room, corners square, faces the viewer, 1.70 m from the "
           "viewer; pixels 2.50 x 2.50 mm"),
          "devices: mouse and keyboard: head"})
        EXPECT_THAT(text, HasSubstr(part));
    const std::string mirrored =
        describe(parse_config(window_with("lower_left = [1, 1, -1]\nupper_left = [1, 3, -1]\n"
                                          "upper_right = [-1, 3.5, -1]\n"),
                              "lab.toml"));
    EXPECT_THAT(mirrored, HasSubstr("faces away from the viewer"));
    EXPECT_THAT(mirrored, HasSubstr("corners of 104.0 degrees"));
    EXPECT_THAT(mirrored, HasSubstr("placed by the desktop"));
}

} // namespace
} // namespace isochron::app
