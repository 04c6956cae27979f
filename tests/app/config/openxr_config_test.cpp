// The `[openxr]` table: reading it, and describing it.
#include "app/config/check_config.h"
#include "app/config/config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace isochron::app {
namespace {

using testing::HasSubstr;

OpenXrConfig parsed(const std::string& lines) {
    return parse_config("[openxr]\n" + lines, "test.toml").openxr;
}

std::string complaint(const std::string& lines) {
    try {
        parsed(lines);
    } catch (const ConfigError& error) {
        return error.what();
    }
    return {};
}

TEST(OpenXrConfig, IsOffUnlessAskedFor) {
    EXPECT_FALSE(parse_config("", "test.toml").openxr.enabled);
    EXPECT_FALSE(parsed("mirror = \"both\"").enabled);
    EXPECT_TRUE(read_config("hmd").openxr.enabled);
    EXPECT_FALSE(read_config("cave4").openxr.enabled);
}

TEST(OpenXrConfig, HoldsWhatTheFileSays) {
    const OpenXrConfig config = parsed("enabled = true\nreference_space = \"local\"\n"
                                       "binding = \"xlib\"\nmirror = \"both\"\nwand = \"left\"\n"
                                       "fallback = \"window\"\ndepth = false\nscale = 1.5\n"
                                       "retry_seconds = 5");
    EXPECT_TRUE(config.enabled);
    EXPECT_EQ(config.fallback, WithoutRuntime::window);
    EXPECT_EQ(config.mirror, stereo::Mirror::both);
    EXPECT_EQ(config.options.space, stereo::OpenXrSpace::local);
    EXPECT_EQ(config.options.binding, stereo::OpenXrBinding::xlib);
    EXPECT_TRUE(config.options.left_handed);
    EXPECT_FALSE(config.options.depth);
    EXPECT_FLOAT_EQ(config.options.scale, 1.5f);
    EXPECT_EQ(config.options.retry.count(), 5.0);
}

TEST(OpenXrConfig, RefusesWhatItDoesNotKnowWithItsPlace) {
    EXPECT_THAT(complaint("mirror = \"top\""), HasSubstr("test.toml:2"));
    EXPECT_THAT(complaint("scale = 9.0"), HasSubstr("test.toml:2"));
    EXPECT_THAT(complaint("referense_space = \"stage\""), HasSubstr("reference_space"));
}

TEST(OpenXrConfig, CheckConfigTellsOfIt) {
    EXPECT_THAT(describe(read_config("hmd")), HasSubstr("openxr: reference space auto"));
    EXPECT_THAT(describe(read_config("hmd")), HasSubstr("wand in the right hand"));
    EXPECT_EQ(describe(read_config("cave4")).find("openxr"), std::string::npos);
}

} // namespace
} // namespace isochron::app
