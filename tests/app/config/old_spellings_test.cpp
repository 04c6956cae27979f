// Files with the spellings of version 0.1 still have the same meaning.
#include "app/config/config.h"
#include "tests/app/config/config_error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>

namespace isochron::app {
namespace {

constexpr const char* kNow = R"([rendering]
shape = "voxel"
surface_color = [0.1, 0.2, 0.3]
[coloring]
by = "value"
map = "gray"
range = [1.0, 2.0]
[[surfaces]]
isovalue = 1.0
color = [0.4, 0.5, 0.6]
)";

constexpr std::array<std::pair<const char*, const char*>, 5> kOld{{
    {"shape", "footprint"},
    {"surface_color", "surface_colour"},
    {"coloring", "colouring"},
    {"\"gray\"", "\"grey\""},
    {"\ncolor", "\ncolour"},
}};

std::string replaced(std::string text, const std::string& now, const std::string& old) {
    text.replace(text.find(now), now.size(), old);
    return text;
}

void expect_as_now(const std::string& text) {
    const Config now = parse_config(kNow, "now.toml"), config = parse_config(text, "old.toml");
    EXPECT_EQ(config.rendering.surface_color, now.rendering.surface_color) << text;
    EXPECT_EQ(config.rendering.cell_shape, now.rendering.cell_shape) << text;
    EXPECT_EQ(config.start.coloring, now.start.coloring) << text;
    ASSERT_EQ(config.surfaces.size(), 1u) << text;
    EXPECT_EQ(config.surfaces[0].color, now.surfaces[0].color) << text;
    EXPECT_EQ(config.surfaces[0].isovalue, now.surfaces[0].isovalue) << text;
}

TEST(OldSpellings, GiveTheSameConfiguration) {
    const Config now = parse_config(kNow, "now.toml");
    EXPECT_EQ(now.rendering.surface_color, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(now.rendering.cell_shape, render::CellShape::voxel);
    EXPECT_EQ(now.start.coloring.map, "gray");
    EXPECT_EQ(now.surfaces.at(0).color, glm::vec3(0.4f, 0.5f, 0.6f));
    std::string all = kNow;
    for (const auto& [word, old] : kOld) {
        expect_as_now(replaced(kNow, word, old));
        all = replaced(all, word, old);
    }
    expect_as_now(all);
}

TEST(OldSpellings, BesideTheNewOneAreAnError) {
    EXPECT_THAT(error_of("[[surfaces]]\ncolor = [0, 0, 1]\ncolour = [0, 1, 0]\n"),
                testing::HasSubstr("lab.toml:3: unknown key 'colour'"));
}

} // namespace
} // namespace isochron::app
