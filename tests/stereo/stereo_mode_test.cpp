// Names of stereo modes, further names that are accepted, and the eyes' places in inverted modes.
#include "stereo/installation.h"
#include "stereo/screen.h"
#include "stereo/stereo_mode.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

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

TEST(StereoMode, MeasuredEyesAreWhereTheyWereMeasuredAndMoveFromTheirMiddle) {
    Viewer viewer;
    const interaction::Pose head{{1, 2, 3}, glm::angleAxis(0.7f, glm::vec3(0, 1, 0))};
    const auto eye = [&](Eye which, float separation) {
        return eye_position(head, which, eyes_of_viewer(viewer, separation));
    };
    const auto in_room = [&](glm::vec3 place) { return head.position + head.orientation * place; };
    const auto expect_at = [](glm::vec3 got, glm::vec3 expected) {
        EXPECT_LT(glm::distance(got, expected), 1e-6f) << got.x << ' ' << got.y << ' ' << got.z;
    };
    expect_at(eye(Eye::left, 0.06f), in_room({-0.03f, 0, 0}));
    viewer.left_eye = {-0.035f, 0.01f, -0.02f};
    viewer.right_eye = {0.029f, 0.012f, -0.021f};
    viewer.eye_separation = glm::distance(*viewer.left_eye, *viewer.right_eye);
    expect_at(eye(Eye::left, viewer.eye_separation), in_room(*viewer.left_eye));
    expect_at(eye(Eye::right, viewer.eye_separation), in_room(*viewer.right_eye));
    const glm::vec3 middle = 0.5f * (*viewer.left_eye + *viewer.right_eye);
    expect_at(eye(Eye::center, 0.05f), in_room(middle));
    expect_at(eye(Eye::left, 0), in_room(middle));
    expect_at(eye(Eye::right, 0.5f * viewer.eye_separation),
              in_room(0.5f * (middle + *viewer.right_eye)));
}

} // namespace
} // namespace isochron::stereo
