// `--check-config` on mistakes of real labs: measures in other units, turned floors, missing
// corners, and displays with frames.
#include "app/config/check_config.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace isochron::app {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

std::vector<std::string> lines_about(const std::string& text) {
    const Config config = parse_config(text, "lab.toml");
    std::vector<std::string> lines;
    for (const ConfigProblem& problem : problems_of(config))
        lines.push_back(line_of(problem, config));
    return lines;
}

/// The shipped CAVE of 3 x 3 m with one thing changed, or added to its end.
std::string cave_with(const std::string& from, const std::string& to,
                      const std::string& more = "") {
    std::string text = read_config("cave4").text;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, text.npos) << from;
    return text.replace(at, from.size(), to) + more;
}
std::string tracked(const std::string& options, const std::string& of_head = "") {
    return cave_with("", "",
                     "\n[dtrack]\nport = 5000\n" + options +
                         "\n[[dtrack.devices]]\nname = \"head\"\nbody = 0\n" + of_head + "\n");
}
testing::Matcher<std::vector<std::string>> one_warning(const std::string& key,
                                                       const std::string& part) {
    return ElementsAre(AllOf(testing::ContainsRegex("^lab.toml:[0-9]+: warning: "), HasSubstr(key),
                             HasSubstr(part)));
}

TEST(CheckMeasures, ViewersAreNearTheirScreens) {
    const std::string position = "position = [0.0, 1.7, 0.0]";
    EXPECT_THAT(lines_about(cave_with(position, "position = [0.0, 17.0, 0.0]")),
                testing::Contains(HasSubstr("14 m from all of the screens, 17 m up")));
    EXPECT_THAT(lines_about(cave_with(position, "position = [0.0, 1700.0, 0.0]")),
                testing::Contains(HasSubstr("1700 m up")));
    EXPECT_THAT(lines_about(cave_with(position, "position = [1.0, 1.9, 3.0]")), IsEmpty());
}

TEST(CheckMeasures, PlanesLeaveSomethingToSee) {
    const std::string context = "context = \"glfw\"\n";
    EXPECT_THAT(lines_about(cave_with(context, context + "near = 9.0\n")),
                one_warning("rendering.near", "behind all screens"));
    EXPECT_THAT(lines_about(cave_with(context, context + "far = 1.0\n")),
                one_warning("rendering.far", "in front of all screens"));
    EXPECT_THAT(lines_about(cave_with(context, context + "near = 0.5\nfar = 3.0\n")), IsEmpty());
}

TEST(CheckMeasures, FloorsLieAsTheViewerStands) {
    const std::string floor = "lower_left = [-1.5, 0.0, 1.5]\nupper_left = [-1.5, 0.0, -1.5]\n"
                              "upper_right = [1.5, 0.0, -1.5]\n";
    EXPECT_THAT(lines_about(cave_with(floor, "lower_left = [-1.5, 0.0, -1.5]\n"
                                             "upper_left = [1.5, 0.0, -1.5]\n"
                                             "upper_right = [1.5, 0.0, 1.5]\n")),
                one_warning("windows.viewports.projection",
                            "upper edge is at the right: turned by 90 degrees"));
}

TEST(CheckMeasures, TrackersUseMetersAndDegrees) {
    EXPECT_THAT(lines_about(tracked("")), IsEmpty());
    EXPECT_THAT(lines_about(tracked("scale = 1.01")), IsEmpty());
    EXPECT_THAT(lines_about(tracked("scale = 1000")), one_warning("dtrack.scale", "1000: meters"));
    EXPECT_THAT(lines_about(tracked("orientation = [0, -90, 3]")), IsEmpty());
    EXPECT_THAT(lines_about(tracked("orientation = [2, 0, 0]")), IsEmpty());
    for (const char* angles : {"[0, -1.5708, 0]", "[3.14159, 0, 0]", "[1.5708, 0.7854, 0]"})
        EXPECT_THAT(lines_about(tracked(fmt::format("orientation = {}", angles))),
                    one_warning("dtrack.orientation", "round in radians"));
    EXPECT_THAT(lines_about(tracked("", "offset = [0, 80, -30]")),
                one_warning("dtrack.devices.offset", "85.44 m from its sensor"));
    EXPECT_THAT(lines_about(tracked("", "offset = [0, 0.08, -0.03]")), IsEmpty());
}

TEST(CheckMeasures, ScreensOnTheHeadAreInFrontOfIt) {
    EXPECT_THAT(lines_about(cave_with("carried_by = \"room\"", "carried_by = \"head\"")),
                testing::Contains(AllOf(HasSubstr("windows.viewports.projection"),
                                        HasSubstr("45 degrees off where the eyes look"))));
}

TEST(CheckMeasures, EveryWindowOfARoomHasCorners) {
    EXPECT_THAT(lines_about(cave_with("", "", "\n[[windows]]\nname = \"more\"\n")),
                testing::Contains(AllOf(HasSubstr("windows.viewports.projection"),
                                        HasSubstr("window more has no corners"))));
}

/// A flat wall of displays of 1 x 1 m, whose pictures are so far apart.
std::string wall_of(int columns, int rows, double gap, double bezel) {
    std::string text;
    for (int x = 0; x < columns; ++x)
        for (int y = 0; y < rows; ++y) {
            const double left = x * (1 + gap), low = y * (1 + gap);
            text += fmt::format("[[windows]]\nname = \"{} {}\"\nsize = [100, 100]\n"
                                "[[windows.viewports]]\n[windows.viewports.projection]\n"
                                "bezel = {}\n"
                                "lower_left = [{}, {}, -2]\nupper_left = [{}, {}, -2]\n"
                                "upper_right = [{}, {}, -2]\n",
                                x, y, bezel, left, low, left, low + 1, left + 1, low + 1);
        }
    return text;
}

TEST(CheckMeasures, DisplaysWithFramesAreOneWarningForTheWallAndNoneWhereTheFramesAreGiven) {
    EXPECT_THAT(lines_about(wall_of(3, 3, 0.02, 0)), ElementsAre(HasSubstr("20 such gaps: bezel")));
    EXPECT_THAT(lines_about(wall_of(3, 3, 0.02, 0.01)), IsEmpty());
    EXPECT_THAT(lines_about(wall_of(3, 3, 0.04, 0.01)), ElementsAre(HasSubstr("such gaps")));
}

} // namespace
} // namespace isochron::app
