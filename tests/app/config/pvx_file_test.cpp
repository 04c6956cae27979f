// ParaView's .pvx files: all that they describe is imported, and errors are reported.
#include "app/config/pvx_file.h"

#include "app/config/check_config.h"
#include "app/config/config_problem.h"
#include "app/config/display_config_text.h"
#include "tests/support/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace isochron::app {
namespace {

using stereo::StereoMode;
using testing::ElementsAre;
using testing::HasSubstr;

class PvxFile : public testing::Test {
  protected:
    PvxImport read(const std::string& text, const PvxOptions& options = {}) {
        return read_pvx(folder_.write("cave.pvx", text), options);
    }
    /// The complaint, without the folder.
    std::string error_of(const std::string& text) {
        try {
            read(text);
        } catch (const ConfigError& error) {
            const std::string what = error.what();
            EXPECT_THAT(what, testing::Not(HasSubstr("\n")));
            return what.substr(what.find("cave.pvx"));
        }
        return "no error";
    }
    test_support::TestFolder folder_;
};

const std::string kCavePvx = R"(<?xml version="1.0" ?>
<pvx>
  <Process Type="client"/>
  <Process Type="server">
    <EyeSeparation Value="0.06"/>
    <Option Name="ShowBorders" Value="1"/>
    <IndependentViewers><Viewer Id="1" EyeSeparation="0.05"/></IndependentViewers>
    <Machine Name="front" Environment="DISPLAY=:0.1" Geometry="1400x1050+1920+0" FullScreen="1"
             LowerLeft="-1 -1 -1" LowerRight="1 -1 -1" UpperRight="1 0.5 -1"
             StereoType="Crystal Eyes"/>
    <Machine Name="front" ViewerId="1" UseOffAxisProjection="0"
             LowerLeft="1 -1 -1" LowerRight="1 -1 1" UpperRight="1 1 1"/>
  </Process>
</pvx>
)";

TEST_F(PvxFile, MachinesViewersAndCornersArrive) {
    const PvxImport import = read(kCavePvx);
    const stereo::Installation& cave = import.installation;
    ASSERT_EQ(cave.windows.size(), 2u);
    const stereo::Window& front = cave.windows[0];
    EXPECT_EQ(front.name, "front");
    EXPECT_EQ(front.size, glm::ivec2(1400, 1050));
    EXPECT_EQ(front.position, glm::ivec2(1920, 0));
    EXPECT_TRUE(front.fullscreen);
    EXPECT_TRUE(front.border);
    EXPECT_EQ(front.stereo, StereoMode::quadbuffer);
    // The third corner of a .pvx is the lower right one, ours the upper left one.
    EXPECT_EQ(front.viewports[0].screen.lower_left, glm::vec3(-1, -1, -1));
    EXPECT_EQ(front.viewports[0].screen.upper_left, glm::vec3(-1, 0.5f, -1));
    EXPECT_EQ(front.viewports[0].screen.upper_right, glm::vec3(1, 0.5f, -1));
    EXPECT_EQ(cave.windows[1].name, "front 2");
    EXPECT_EQ(cave.windows[1].stereo, StereoMode::mono);
    EXPECT_EQ(cave.windows[1].viewports[0].viewer, 1u);
    EXPECT_EQ(cave.windows[1].viewports[0].screen.upper_left, glm::vec3(1, 1, -1));
    ASSERT_EQ(cave.viewers.size(), 2u);
    EXPECT_FLOAT_EQ(cave.viewers[0].eye_separation, 0.06f);
    EXPECT_FLOAT_EQ(cave.viewers[1].eye_separation, 0.05f);
    EXPECT_THAT(import.notes, ElementsAre(HasSubstr("cave.pvx:8: front: Environment"),
                                          HasSubstr("cave.pvx:11: front 2: without "
                                                    "UseOffAxisProjection")));
}

TEST_F(PvxFile, EveryMachineIsANodeInItsPlace) {
    const stereo::Installation cave = read(kCavePvx).installation;
    EXPECT_EQ(cave.windows[0].node, 0);
    EXPECT_EQ(cave.windows[1].node, 1);
    EXPECT_EQ(parse_config(display_config_text(cave), "cave.toml").installation.windows[1].node, 1);
}

TEST_F(PvxFile, AMachineWithoutCornersIsAWindowOnADesktop) {
    const PvxImport import = read(
        "<pvx>\n<Machine Name=\"localhost\"/>\n<UseOffAxisProjection Value=\"false\"/>\n</pvx>");
    const stereo::Screen& screen = import.installation.windows[0].viewports[0].screen;
    EXPECT_TRUE(screen.carried_by_head);
    EXPECT_TRUE(screen.fit_aspect);
    EXPECT_THAT(import.notes, testing::Contains(HasSubstr("cave.pvx:2: localhost: no corners")));
    const Config config = parse_config(display_config_text(import.installation), "imported.toml");
    EXPECT_THAT(problems_of(config), testing::IsEmpty());
}

TEST_F(PvxFile, TheThirdCornerMayBeTheUpperLeftOne) {
    const PvxImport import = read("<pvx><Machine LowerLeft=\"-1 -1 -1\" LowerRight=\"1 -1 -1\" "
                                  "UpperLeft=\"-1 0.5 -1\"/></pvx>");
    const stereo::Screen& screen = import.installation.windows[0].viewports[0].screen;
    EXPECT_EQ(screen.upper_left, glm::vec3(-1, 0.5f, -1));
    EXPECT_EQ(screen.upper_right, glm::vec3(1, 0.5f, -1));
}

TEST_F(PvxFile, UnitAndOriginPutTheCornersIntoTheRoom) {
    const PvxImport import =
        read("<pvx><EyeSeparation Value=\"0.2\"/><Machine LowerLeft=\"-5 0 -5\" LowerRight=\"5 0 "
             "-5\" UpperRight=\"5 10 -5\"/></pvx>",
             {.meters_per_unit = 0.3048f, .origin = {0.0f, 0.5f, 1.0f}});
    const stereo::Screen& screen = import.installation.windows[0].viewports[0].screen;
    EXPECT_NEAR(screen.upper_right.x, 1.524f, 1e-5f);
    EXPECT_NEAR(screen.upper_right.y, 3.548f, 1e-5f);
    EXPECT_NEAR(screen.upper_right.z, -0.524f, 1e-5f);
    EXPECT_EQ(import.installation.viewers[0].position, glm::vec3(0, 0.5f, 1));
    EXPECT_NEAR(import.installation.viewers[0].eye_separation, 0.06096f, 1e-6f);
    EXPECT_EQ(import.installation.windows[0].name, "window 1");
}

TEST_F(PvxFile, WhatIsWrittenAsTomlIsTheSameInstallation) {
    const stereo::Installation cave = read(kCavePvx).installation;
    const Config config = parse_config(display_config_text(cave), "cave.toml");
    EXPECT_EQ(config.installation, cave);
}

TEST_F(PvxFile, EveryStereoTypeOfParaViewHasItsMode) {
    const auto mode_of = [&](const std::string& word) {
        return read(
                   "<pvx><Machine StereoType=\"" + word +
                   "\" LowerLeft=\"-1 -1 -1\" LowerRight=\"1 -1 -1\" UpperRight=\"1 1 -1\"/></pvx>")
            .installation.windows[0]
            .stereo;
    };
    EXPECT_EQ(mode_of("Crystal Eyes"), StereoMode::quadbuffer);
    EXPECT_EQ(mode_of("Red-Blue"), StereoMode::anaglyph_red_cyan);
    EXPECT_EQ(mode_of("Anaglyph"), StereoMode::anaglyph_red_cyan);
    EXPECT_EQ(mode_of("Interlaced"), StereoMode::vertical_interlaced);
    EXPECT_EQ(mode_of("Dresden"), StereoMode::horizontal_interlaced);
    EXPECT_EQ(mode_of("Checkerboard"), StereoMode::checkerboard);
    EXPECT_EQ(mode_of("SplitViewportHorizontal"), StereoMode::side_by_side);
    EXPECT_EQ(mode_of("Left"), StereoMode::left);
    EXPECT_EQ(mode_of("Right"), StereoMode::right);
}

TEST_F(PvxFile, WhatIsWrongIsOneLineWithItsPlace) {
    const auto machine = [](const std::string& more) {
        return "<pvx>\n<Machine LowerLeft=\"-1 -1 -1\" LowerRight=\"1 -1 -1\" UpperRight=\"1 1 "
               "-1\" " +
               more + "/>\n</pvx>";
    };
    EXPECT_EQ(error_of(""), "cave.pvx:1: not well-formed XML (XML_ERROR_EMPTY_DOCUMENT)");
    EXPECT_EQ(error_of("<pvx>\n<Machine>\n</pvx>"),
              "cave.pvx:2: not well-formed XML (XML_ERROR_MISMATCHED_ELEMENT)");
    EXPECT_EQ(error_of("<html/>"), "cave.pvx: expected <pvx>, got <html>");
    EXPECT_EQ(error_of("<pvx/>"), "cave.pvx:1: pvx: it has no Machine");
    EXPECT_EQ(error_of("<pvx><Machine LowerRight=\"1 -1 -1\"/></pvx>"),
              "cave.pvx:1: Machine: LowerLeft is missing");
    EXPECT_EQ(error_of("<pvx><Machine LowerLeft=\"-1 -1 -1\" LowerRight=\"1 -1 -1\"/></pvx>"),
              "cave.pvx:1: Machine: UpperRight is missing");
    EXPECT_EQ(error_of("<pvx><Machine LowerLeft=\"1 2\"/></pvx>"),
              "cave.pvx:1: Machine: LowerLeft: expected 3 numbers, got '1 2'");
    EXPECT_THAT(error_of("<pvx><Machine LowerLeft=\"1 2 x\"/></pvx>"), HasSubstr("got '1 2 x'"));
    EXPECT_THAT(error_of("<pvx><Machine LowerLeft=\"1 2 nan\"/></pvx>"), HasSubstr("expected 3"));
    EXPECT_THAT(error_of("<pvx><Machine LowerLeft=\"1 2 3 4\"/></pvx>"), HasSubstr("expected 3"));
    EXPECT_EQ(error_of(machine("Geometry=\"800 by 600\"")),
              "cave.pvx:2: Machine: Geometry: expected WIDTHxHEIGHT+X+Y in pixels, got '800 by "
              "600'");
    EXPECT_THAT(error_of(machine("Geometry=\"800x0+0+0\"")), HasSubstr("Geometry"));
    EXPECT_EQ(error_of(machine("StereoType=\"Quad\"")),
              "cave.pvx:2: Machine: StereoType: 'Quad' is not one of ParaView's");
    EXPECT_THAT(error_of(machine("ViewerId=\"many\"")), HasSubstr("ViewerId: expected a number"));
    EXPECT_THAT(error_of(machine("ViewerId=\"1\"")), HasSubstr("without a gap"));
    EXPECT_THAT(error_of("<pvx><EyeSeparation Value=\"0.3\"/></pvx>"),
                HasSubstr("EyeSeparation: Value: expected 0 to 0.1 m, got 0.3 m"));
    EXPECT_THAT(error_of("<pvx><EyeSeparation/></pvx>"), HasSubstr("Value is missing"));
    EXPECT_THROW(read_pvx(folder_.path() / "none.pvx", {}), ConfigError);
    EXPECT_THROW(read_pvx(folder_.path(), {}), ConfigError);
}

} // namespace
} // namespace isochron::app
