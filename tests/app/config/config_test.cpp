// Configuration files: what is shipped is valid, and what is wrong is named with its place.
#include "app/config/color_map_file.h"
#include "app/config/config_words.h"
#include "app/text.h"
#include "tests/app/config/config_error.h"
#include "tests/support/paths.h"
#include "tests/support/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

namespace isochron::app {
namespace {

using testing::HasSubstr;

TEST(ConfigFields, EachHasAKeyAndAMemberOfItsOwn) {
    Config config;
    std::set<std::string> keys;
    std::set<const void*> members;
    each_field(
        [&](const Field& field, const auto& member) {
            EXPECT_TRUE(members.insert(&member).second) << field.key;
            if (!Table<std::remove_cvref_t<
                    decltype(member)>>) // whose keys may stand in one table with others
                EXPECT_TRUE(keys.insert(field.key).second) << field.key;
        },
        config);
    EXPECT_GT(keys.size(), 80u);
}

TEST(Config, LooksArrive) {
    const Config config = parse_config(R"(
[[surfaces]]
isovalue = 2.5
color = [1.0, 0.5, 0.0]
opacity = 0.5
[[surfaces]]
quantile = 0.5
[rendering]
samples = 2
picture_samples = 8
blending = "display"
drawn_by = "gpu"
[lighting]
key_direction = [0, 1, 0]
reflectance = 0.1
[coloring]
by = "value"
map = "polar"
range = [0.1, 3e6]
[look]
light = [40, 30]
)",
                                       "lab.toml");
    ASSERT_EQ(config.surfaces.size(), 2u);
    EXPECT_EQ(config.surfaces[0].isovalue, 2.5);
    EXPECT_EQ(config.surfaces[0].color, glm::vec3(1.0f, 0.5f, 0.0f));
    EXPECT_EQ(config.surfaces[0].opacity, 0.5f);
    EXPECT_FALSE(config.surfaces[1].isovalue);
    EXPECT_EQ(config.surfaces[1].quantile, 0.5);
    EXPECT_NE(config.surfaces[1].color, config.surfaces[0].color);
    EXPECT_EQ(config.rendering.samples, 2);
    EXPECT_EQ(config.pictures.samples, 8);
    EXPECT_EQ(config.rendering.blending, Blending::display);
    EXPECT_EQ(config.rendering.drawn_by, render::DrawnBy::gpu);
    EXPECT_EQ(config.rendering.appearance.key_direction, glm::vec3(0, 1, 0));
    EXPECT_FLOAT_EQ(config.rendering.appearance.reflectance, 0.1f);
    EXPECT_EQ(config.start.coloring.by, interaction::ColorBy::value);
    EXPECT_EQ(config.start.coloring.map, "coolwarm"); // by its older name
    EXPECT_EQ(config.start.coloring.range, (std::array{0.1, 3e6}));
    EXPECT_EQ(config.start.look.light, (std::array{40.0, 30.0}));
    EXPECT_EQ(parse_config("[coloring]\narray = \"heat\"\n", "test.toml").start.coloring.array,
              "heat");
    EXPECT_EQ(
        parse_config("[coloring]\npercentiles = [2, 98]\n", "test.toml").start.coloring.percentiles,
        (std::array{2.0, 98.0}));
}

constexpr const char* kMaps = R"([
  {"Name": "two", "ColorSpace": "RGB", "RGBPoints": [10, 0, 0, 0, 30, 1, 0.5, 0]},
  {"Name": "steps", "ColorSpace": "Step", "RGBPoints": [0, 1, 0, 0, 0.5, 0, 1, 0, 1, 0, 0, 1]},
  {"Name": "hues", "ColorSpace": "HSV", "RGBPoints": [0, 1, 0, 0, 1, 1, 0, 1]}])";

TEST(ColorMapFiles, OfParaViewAreRead) {
    const auto maps = parse_color_maps(kMaps, "maps.json");
    ASSERT_EQ(maps.size(), 3u);
    EXPECT_EQ(maps[0].name, "two");
    ASSERT_EQ(maps[0].colors.size(), kLoadedColors);
    EXPECT_EQ(maps[0].colors.front(), 0x000000u);
    EXPECT_EQ(maps[0].colors.back(), 0xff8000u);
    EXPECT_NEAR(maps[0].colors[kLoadedColors / 2] >> 16, 128, 2);
    EXPECT_EQ(maps[1].colors[kLoadedColors / 2 - 2], 0xff0000u);
    EXPECT_EQ(maps[1].colors[kLoadedColors / 2 + 2], 0x00ff00u);
    // The short way from red to magenta has no green, and red all along.
    for (const std::uint32_t color : maps[2].colors)
        EXPECT_EQ(color & 0xffff00u, 0xff0000u);
    EXPECT_EQ(parse_color_maps(R"({"Name": "one", "RGBPoints": [0, 1, 1, 1, 1, 0, 0, 0]})", "a")
                  .front()
                  .colors.front(),
              0xffffffu);
}

TEST(ColorMapFiles, ThatAreDamagedSayWhatIsWrongInOneLine) {
    const auto error = [](const std::string& text) -> std::string {
        try {
            parse_color_maps(text, "maps.json");
        } catch (const ConfigError& problem) {
            return problem.what();
        }
        return "";
    };
    EXPECT_THAT(error("not JSON"), HasSubstr("maps.json: expected color maps"));
    EXPECT_THAT(error("[]"), HasSubstr("got 0"));
    EXPECT_THAT(error("[3]"), HasSubstr("map 0"));
    EXPECT_THAT(error(R"([{"RGBPoints": []}])"), HasSubstr("Name"));
    EXPECT_THAT(error(R"([{"Name": "m", "RGBPoints": [0, 1, 1, 1, 1, 0, 0]}])"), HasSubstr("four"));
    EXPECT_THAT(error(R"([{"Name": "m", "RGBPoints": [0, 1, 1, 1, 0, 0, 0, 0]}])"),
                HasSubstr("above 0"));
    EXPECT_THAT(error(R"([{"Name": "m", "RGBPoints": [0, 1, 2, 1, 1, 0, 0, 0]}])"),
                HasSubstr("got 2"));
}

TEST(ColorMapFiles, OfAConfigurationLieBesideIt) {
    const test_support::TestFolder folder;
    std::ofstream(folder.path() / "maps.json") << kMaps;
    const std::string name = (folder.path() / "lab.toml").string();
    const Config config = parse_config(
        "[coloring]\nfile = \"maps.json\"\nfile_map = \"steps\"\nbands = 3\nreversed = true\n",
        name);
    ASSERT_EQ(config.color_maps.size(), 3u);
    EXPECT_EQ(config.start.coloring.map, "steps");
    EXPECT_EQ(config.start.coloring.colors, config.color_maps[1].colors);
    EXPECT_EQ(config.start.coloring.bands, 3u);
    EXPECT_TRUE(config.start.coloring.reversed);
    EXPECT_THAT(error_of("[coloring]\nfile = \"none.json\"\n"), HasSubstr("none.json"));
    EXPECT_THAT(error_of("[coloring]\nlogarithmic = true\nrange = [0, 1]\n"), HasSubstr("above 0"));
}

TEST(Config, LooksThatCannotBeAreErrorsWithTheirPlace) {
    EXPECT_THAT(error_of("[look]\nbackground = \"pink\"\n"), HasSubstr("lab.toml:2"));
    EXPECT_THAT(error_of("[look]\nocclusion = 2\n"), HasSubstr("lab.toml:2"));
    EXPECT_EQ(parse_config("[time]\nbetween = \"blend\"\n", "lab.toml").between,
              interaction::BetweenSteps::blend);
    EXPECT_EQ(parse_config("[time]\nbetween = \"hold\"\n", "lab.toml").between,
              interaction::BetweenSteps::hold);
    EXPECT_FALSE(parse_config("[time]\nbetween = \"auto\"\n", "lab.toml").between);
    EXPECT_THAT(error_of("[time]\nbetween = \"often\"\n"), HasSubstr("lab.toml:2"));
    EXPECT_THAT(error_of("[coloring]\nmap = \"rainbow\"\n"), HasSubstr("lab.toml:2"));
    EXPECT_THAT(error_of("[coloring]\nrange = [2, 1]\n"), HasSubstr("ascending"));
    EXPECT_THAT(error_of("[coloring]\npercentiles = [98, 2]\n"), HasSubstr("ascending"));
    EXPECT_THAT(error_of("[coloring]\npercentiles = [2, 101]\n"), HasSubstr("0 to 100"));
    EXPECT_THAT(error_of("[coloring]\npercentiles = [2, 98]\nrange = [1, 2]\n"),
                HasSubstr("got both"));
    EXPECT_THAT(error_of("[lighting]\nkey_direction = [0, 0, 0]\n"), HasSubstr("lab.toml:2"));
    EXPECT_THAT(error_of("[[surfaces]]\nisovalue = 1\nquantile = 0.5\n"), HasSubstr("quantile"));
    EXPECT_THAT(error_of("[[surfaces]]\ncolor = [0, 0, 2]\n"), HasSubstr("from 0 to 1, got 2"));
    std::string nine;
    for (int i = 0; i < 9; ++i)
        nine += "[[surfaces]]\nisovalue = 1\n";
    EXPECT_THAT(error_of(nine), HasSubstr("at most 8, got 9"));
}

TEST(Config, ValuesArrive) {
    const Config config = parse_config(R"(
[viewer]
eye_separation = 0.05
position = [1, 2.5, -3]
[[windows]]
size = [640, 480]
stereo = "top_bottom"
[[windows.viewports]]
[windows.viewports.projection]
carried_by = "head"
lower_left = [-2, -1, -1]
upper_left = [-2, 1, -1]
upper_right = [2, 1, -1]
[quality]
settle_ms = 300
mode = "fast"
settled = "gaussian"
frame_budget_ms = 8.5
longest_ms = 50
least_resolution = 0.5
still_budget_ms = 200
)",
                                       "lab.toml");
    EXPECT_FLOAT_EQ(config.installation.viewers[0].eye_separation, 0.05f);
    EXPECT_EQ(config.emulation.head.position, glm::vec3(1.0f, 2.5f, -3.0f));
    ASSERT_EQ(config.installation.windows.size(), 1u);
    const stereo::Window& window = config.installation.windows[0];
    EXPECT_EQ(window.size, glm::ivec2(640, 480));
    EXPECT_EQ(window.stereo, stereo::StereoMode::top_bottom);
    EXPECT_TRUE(window.viewports[0].screen.carried_by_head);
    EXPECT_EQ(window.viewports[0].screen.upper_left, glm::vec3(-2.0f, 1.0f, -1.0f));
    EXPECT_DOUBLE_EQ(config.quality.stillness.settle.count(), 0.3);
    EXPECT_EQ(config.start.quality, interaction::QualityMode::fast);
    EXPECT_EQ(config.quality.settled, render::Footprint::gaussian);
    EXPECT_DOUBLE_EQ(config.quality.frame_budget_ms, 8.5);
    EXPECT_DOUBLE_EQ(config.quality.longest_ms, 50);
    EXPECT_DOUBLE_EQ(config.quality.least_resolution, 0.5);
    EXPECT_DOUBLE_EQ(config.quality.still_budget_ms, 200);
}

TEST(Config, WhatASettledPictureIsDrawnWithIsMeasuredUnlessItIsNamed) {
    EXPECT_EQ(parse_config("", "lab.toml").quality.settled, std::nullopt);
    EXPECT_EQ(parse_config("", "lab.toml").rendering.cell_shape, render::CellShape::plane);
    EXPECT_EQ(parse_config("[rendering]\nshape = \"voxel\"\n", "lab.toml").rendering.cell_shape,
              render::CellShape::voxel);
    EXPECT_EQ(parse_config("[quality]\nsettled = \"auto\"\n", "lab.toml").quality.settled,
              std::nullopt);
    EXPECT_EQ(parse_config("[quality]\nsettled = \"surface\"\n", "lab.toml").quality.settled,
              render::Footprint::surface);
    EXPECT_THAT(error_of("[quality]\nsettled = \"quad\"\n"),
                HasSubstr("lab.toml:2: quality.settled: unknown value 'quad'"));
    EXPECT_THAT(error_of("[quality]\nframe_budget_ms = -1\n"),
                HasSubstr("lab.toml:2: quality.frame_budget_ms: expected a number from 0 to 1000"));
    EXPECT_THAT(error_of("[quality]\nframe_budget = 8\n"),
                HasSubstr("did you mean 'frame_budget_ms'?"));
}

TEST(Config, UnknownKeyNamesLineAndNearestKey) {
    EXPECT_EQ(
        error_of("version = 1\n[viewer]\neye_seperation = 0.06\n"),
        "lab.toml:3: unknown key 'eye_seperation' in [viewer]; did you mean 'eye_separation'?");
}

TEST(Config, UnknownWordNamesTheWordsAndTheNearest) {
    const std::string error = error_of("[[windows]]\nstereo = \"side_by_sid\"\n");
    EXPECT_THAT(error, HasSubstr("lab.toml:2: windows.stereo: unknown value 'side_by_sid'"));
    EXPECT_THAT(error, HasSubstr("did you mean 'side_by_side'?"));
}

TEST(Config, ValueOutOfRangeSaysWhatIsExpected) {
    EXPECT_EQ(error_of("[viewer]\neye_separation = 0.5\n"),
              "lab.toml:2: viewer.eye_separation: expected a number from 0 to 0.1, got 0.5");
    EXPECT_THAT(error_of("[viewer]\neye_separation = nan\n"), HasSubstr("lab.toml:2"));
}

TEST(Config, WrongTypeSaysBoth) {
    EXPECT_EQ(error_of("[viewer]\neye_separation = \"wide\"\n"),
              "lab.toml:2: viewer.eye_separation: expected a number, got a string");
    EXPECT_THAT(error_of("[viewer]\nposition = [0, 1]\n"),
                HasSubstr("expected an array of 3 numbers"));
    EXPECT_THAT(error_of("viewer = 3\n"), HasSubstr("lab.toml:1: viewer: expected a table"));
    EXPECT_THAT(error_of("[[windows]]\nfullscreen = 1\n"), HasSubstr("expected true or false"));
}

TEST(Config, SyntaxErrorNamesTheLine) {
    EXPECT_THAT(error_of("version = 1\n[viewer\n"), HasSubstr("lab.toml:2"));
}

TEST(Config, NewerVersionIsRefused) {
    EXPECT_THAT(error_of("version = 2\n"), HasSubstr("lab.toml:1: version"));
}

TEST(Config, FlatScreenIsRefused) {
    EXPECT_THAT(error_of("[[windows]]\n[[windows.viewports]]\n[windows.viewports.projection]\n"
                         "lower_left = [0,0,0]\nupper_left = [0,0,0]\nupper_right = [1,0,0]\n"),
                HasSubstr("0 m high"));
}

TEST(Config, AScreenNeedsAllOfItsCorners) {
    const std::string head = "[[windows]]\n[[windows.viewports]]\n[windows.viewports.projection]\n";
    EXPECT_THAT(error_of(head + "upper_left = [0,1,0]\nupper_right = [1,1,0]\n"),
                HasSubstr("lab.toml:3: windows.viewports.projection.lower_left: missing"));
    EXPECT_NO_THROW(parse_config(head + "carried_by = \"head\"\n", "lab.toml"));
}

TEST(Config, AnEmptyFileIsADefaultAndAFolderIsNone) {
    const test_support::TestFolder folder;
    EXPECT_EQ(read_config(folder.write("empty.toml", "")).installation.windows.size(), 1u);
    EXPECT_THROW(read_config(folder.path()), ConfigError);
}

TEST(Config, NearestWordIsSilentAboutStrangers) {
    EXPECT_EQ(nearest_word("settle", {"settle_ms", "mode"}), "settle_ms");
    EXPECT_EQ(nearest_word("xyzzy", {"settle_ms", "mode"}), "");
}

} // namespace
} // namespace isochron::app
