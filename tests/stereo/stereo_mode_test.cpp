// Names of stereo modes, further names that are accepted, and the eyes' places in inverted modes.
#include "stereo/installation.h"
#include "stereo/stereo_mode.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

namespace isochron::stereo {
namespace {

TEST(StereoMode, EveryModeHasOneNameThatLeadsBackToIt) {
    std::set<std::string_view> names;
    for (const StereoMode mode : all_stereo_modes()) {
        EXPECT_TRUE(names.insert(name_of(mode)).second) << name_of(mode);
        EXPECT_EQ(stereo_mode_from_name(name_of(mode)), mode);
    }
    EXPECT_EQ(names.size(), 19u);
    EXPECT_FALSE(stereo_mode_from_name("sideways"));
}

TEST(StereoMode, EveryWordHasAnInvertedFormThatIsUnderstood) {
    for (const StereoMode mode : all_stereo_modes()) {
        if (is_inverted(mode))
            continue;
        const auto inverted = stereo_mode_from_name(std::string(name_of(mode)) + "_inverted");
        ASSERT_TRUE(inverted) << name_of(mode);
        EXPECT_EQ(is_inverted(*inverted), eyes_of(mode).size() == 2);
        EXPECT_EQ(eyes_of(*inverted).size(), eyes_of(mode).size());
    }
    EXPECT_EQ(stereo_mode_from_name("left_inverted"), StereoMode::right);
    EXPECT_EQ(stereo_mode_from_name("right_inverted"), StereoMode::left);
    EXPECT_EQ(stereo_mode_from_name("mono_inverted"), StereoMode::mono);
    EXPECT_EQ(stereo_mode_words().size(), all_stereo_modes().size() + 3);
}

TEST(StereoMode, OnlyInvertedModesExchangeTheEyes) {
    for (const StereoMode mode : all_stereo_modes()) {
        EXPECT_EQ(place_of(Eye::left, mode), is_inverted(mode) ? Eye::right : Eye::left);
        EXPECT_EQ(place_of(Eye::right, mode), is_inverted(mode) ? Eye::left : Eye::right);
        EXPECT_EQ(place_of(Eye::center, mode), Eye::center);
        EXPECT_FALSE(is_inverted(upright(mode)));
    }
}

TEST(StereoMode, AWindowThatIsConfiguredLikeTheFirstFollowsTheLiveMode) {
    Installation installation;
    installation.windows.resize(3);
    installation.windows[0].stereo = installation.windows[1].stereo = StereoMode::quadbuffer;
    const auto shown = [&](std::size_t window) {
        return mode_of(installation.windows[window], installation, StereoMode::top_bottom);
    };
    EXPECT_EQ(shown(0), StereoMode::top_bottom);
    EXPECT_EQ(shown(1), StereoMode::top_bottom);
    EXPECT_EQ(shown(2), StereoMode::mono) << "the operator's window";
}

TEST(StereoMode, LiveEyeSeparationMovesEveryViewersEyesInProportion) {
    Installation installation;
    installation.viewers.resize(2);
    installation.viewers[0].eye_separation = 0.06f;
    installation.viewers[1].eye_separation = 0.05f;
    const auto separation = [&](std::size_t viewer, float live) {
        return eye_separation_of(installation.viewers[viewer], installation, live);
    };
    EXPECT_EQ(separation(0, 0.063f), 0.063f) << "the first viewer's is the live one, exactly";
    EXPECT_FLOAT_EQ(separation(1, 0.06f), 0.05f);
    EXPECT_FLOAT_EQ(separation(1, 0.03f), 0.025f);
    EXPECT_EQ(separation(0, 0.0f), 0.0f);
    EXPECT_EQ(separation(1, 0.0f), 0.0f);
    installation.viewers[1].eye_separation = 0.09f;
    EXPECT_EQ(separation(1, 0.1f), 0.1f) << "no eyes are wider apart";
}

} // namespace
} // namespace isochron::stereo
