// The panel in the room: its geometry, and who gets the wand's buttons.
#include "interaction/controls/controls.h"
#include "interaction/controls/panel_pointer.h"

#include "tests/interaction/input_builders.h"
#include "tests/support/test_seed.h"

#include <gtest/gtest.h>

namespace isochron::interaction {
namespace {

constexpr PanelSize kSize{0.5f, 0.6f};
constexpr std::uint64_t kGrabButton = bit(WandButton::grab), kFly = bit(WandButton::fly);

Pose random_pose(Random& random) {
    const auto coordinate = [&] { return static_cast<float>(uniform(random, -2, 2)); };
    return {{coordinate(), coordinate(), coordinate()}, random_rotation(random)};
}

/// A ray from a place through another.
Pose ray_through(const glm::vec3& from, const glm::vec3& to) {
    const glm::vec3 way = glm::normalize(to - from);
    const glm::vec3 up = std::abs(way.y) > 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return {from, glm::quatLookAt(way, up)};
}

TEST(RoomPanel, ARayThroughAPlaceOfThePanelHitsThatPlaceAtItsDistance) {
    Random random(isochron::test_seed());
    for (int i = 0; i < 500; ++i) {
        const Pose panel = random_pose(random);
        const glm::vec2 at(uniform(random, -0.5, 1.5), uniform(random, -0.5, 1.5));
        const glm::vec3 place = place_on(panel, kSize, at);
        const glm::vec3 before(uniform(random, -0.5, 0.5), uniform(random, -0.5, 0.5),
                               uniform(random, 0.2, 1));
        const glm::vec3 from = panel.position + panel.orientation * before;
        const auto hit = hit_of(ray_through(from, place), panel, kSize);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->at.x, at.x, 1e-4);
        EXPECT_NEAR(hit->at.y, at.y, 1e-4);
        EXPECT_NEAR(hit->distance, glm::distance(from, place), 1e-4);
        EXPECT_EQ(hit->inside(), at.x >= 0 && at.x <= 1 && at.y >= 0 && at.y <= 1);
        const glm::vec3 behind =
            panel.position + panel.orientation * (before * glm::vec3(1, 1, -1));
        EXPECT_FALSE(hit_of(ray_through(behind, place), panel, kSize)) << "from the back";
        EXPECT_FALSE(hit_of(ray_through(from, 2.0f * from - place), panel, kSize))
            << "away from it";
    }
}

TEST(RoomPanel, CornersGoAroundFromTheLowerLeft) {
    const auto corners = corners_of({{1, 2, 3}, {1, 0, 0, 0}}, kSize);
    EXPECT_EQ(corners[0], glm::vec3(0.75f, 1.7f, 3));
    EXPECT_EQ(corners[1], glm::vec3(0.75f, 2.3f, 3));
    EXPECT_EQ(corners[2], glm::vec3(1.25f, 2.3f, 3));
    EXPECT_EQ(corners[3], glm::vec3(1.25f, 1.7f, 3));
}

TEST(RoomPanel, AppearsAheadBelowEyeLevelFacingTheEyesWithLevelEdges) {
    Random random(isochron::test_seed());
    for (int i = 0; i < 200; ++i) {
        const Pose head = random_pose(random);
        const Pose panel = ahead_of(head, 0.65f);
        const glm::vec3 to_panel = panel.position - head.position;
        EXPECT_NEAR(glm::length(to_panel), 0.65, 1e-4);
        EXPECT_NEAR(to_panel.y, -0.65 * std::sin(0.26), 1e-4);
        const glm::vec3 x = panel.orientation * glm::vec3(1, 0, 0);
        const glm::vec3 z = panel.orientation * glm::vec3(0, 0, 1);
        EXPECT_NEAR(x.y, 0, 1e-5);
        EXPECT_NEAR(glm::dot(z, -to_panel), 0.65, 1e-4);
        EXPECT_GT((panel.orientation * glm::vec3(0, 1, 0)).y, 0.5);
        const glm::vec3 ahead = head.orientation * glm::vec3(0, 0, -1);
        if (std::abs(ahead.y) < 0.95f) {
            EXPECT_GT(glm::dot(glm::vec2(ahead.x, ahead.z), glm::vec2(to_panel.x, to_panel.z)), 0);
        }
    }
}

TEST(RoomPanel, CallingItShowsItSendsItAwayAndFetchesItFromBehind) {
    const Pose turned{kStanding.position, glm::angleAxis(3.0f, glm::vec3(0, 1, 0))};
    const RoomPanel first = called({}, kStanding, 0.65f);
    EXPECT_TRUE(first.shown);
    EXPECT_EQ(first.pose, beside(kStanding, 0.65f));
    EXPECT_EQ(called(first, kStanding, 0.65f), (RoomPanel{false, first.pose}));
    EXPECT_EQ(called(first, turned, 0.65f), (RoomPanel{true, beside(turned, 0.65f)}));
    const Pose away{{3, 1.6f, 2}, {1, 0, 0, 0}};
    EXPECT_EQ(called(first, away, 0.65f), (RoomPanel{true, beside(away, 0.65f)}));
}

TEST(RoomPanel, WhereADesktopsWindowLeavesRoomForItItStandsThereHoweverTheHeadIsTurned) {
    const Pose place{{-0.6f, 0.1f, -0.5f}, {1, 0, 0, 0}};
    for (const float turn : {0.0f, 1.0f, 2.5f}) {
        const Pose head{{1, 1.6f, 2}, glm::angleAxis(turn, glm::normalize(glm::vec3(0.3f, 1, 0)))};
        const RoomPanel first = called({}, head, 0.65f, place);
        const glm::vec3 seen =
            glm::conjugate(head.orientation) * (first.pose.position - head.position);
        EXPECT_NEAR(glm::distance(seen, place.position), 0, 1e-5);
        EXPECT_NEAR(std::abs(glm::dot(first.pose.orientation, head.orientation)), 1, 1e-5);
        EXPECT_EQ(called(first, head, 0.65f, place), (RoomPanel{false, first.pose}));
    }
}

TEST(RoomPanel, KeyAndWandButtonCallItOncePerPress) {
    for (const InputState& pressed :
         {InputState{{}, {head_at(kStanding), keys_down(bit(Action::room_panel))}},
          InputState{{}, {head_at(kStanding), wand_at(kStanding, bit(WandButton::room_panel))}}}) {
        Controls controls;
        Settings settings;
        const ControlContext context{.settings = settings};
        EXPECT_FALSE(controls.update({{}, {head_at(kStanding)}}, context).room_panel);
        const Commands commands = controls.update(pressed, context);
        ASSERT_TRUE(commands.room_panel);
        EXPECT_TRUE(commands.room_panel->shown);
        settings.room_panel = *commands.room_panel;
        EXPECT_FALSE(controls.update(pressed, context).room_panel) << "still held";
    }
}

class PanelPointerTest : public testing::Test {
  protected:
    /// One frame with the wand pointing at fractions from the top left.
    const PanelTouch& point(glm::vec2 at, std::uint64_t buttons = 0, float scale = 0) {
        const glm::vec3 place = place_on(touched_.panel.pose, kSize, at);
        input_ = {{}, {head_at(kStanding), wand_at(ray_through(kHand, place), buttons, 0, scale)}};
        return update();
    }
    const PanelTouch& update() {
        pointer_.update(input_, touched_);
        left_ = pointer_.rest_of(input_);
        return pointer_.touch();
    }
    std::uint64_t buttons_left() const { return left_.find("wand")->buttons; }
    float stick_left() const { return left_.find("wand")->valuators[1]; }

    static constexpr glm::vec3 kHand{0.2f, 1.2f, -0.2f};
    static constexpr glm::vec2 kInside{0.3f, 0.6f}, kBeside{1.4f, 0.6f}, kTitle{0.5f, 0.02f};
    TouchedPanel touched_{{true, ahead_of(kStanding, 0.65f)}, kSize, 0.04f, kStanding.position};
    PanelPointer pointer_;
    InputState input_, left_;
};

TEST_F(PanelPointerTest, AClickOnThePanelIsThePanelsAlone) {
    EXPECT_FALSE(point(kInside).pressed);
    EXPECT_NEAR(pointer_.touch().hit->at.x, kInside.x, 1e-4);
    EXPECT_TRUE(point(kInside, kGrabButton | kFly).pressed);
    EXPECT_EQ(buttons_left(), 0u);
    EXPECT_FALSE(point(kInside, kFly).pressed);
    EXPECT_EQ(buttons_left(), 0u);
}

TEST_F(PanelPointerTest, AClickBesideItIsTheWorldsAndStaysSoOverThePanel) {
    EXPECT_FALSE(point(kBeside, kGrabButton).hit);
    EXPECT_EQ(buttons_left(), kGrabButton);
    EXPECT_FALSE(point(kInside, kGrabButton).hit);
    EXPECT_FALSE(pointer_.touch().pressed);
    EXPECT_EQ(buttons_left(), kGrabButton);
    EXPECT_TRUE(point(kInside).hit);
    EXPECT_TRUE(point(kInside, kGrabButton).pressed);
}

TEST_F(PanelPointerTest, ADragStaysWithThePanelUntilTheButtonIsLetGo) {
    point(kInside, kGrabButton);
    const PanelTouch& dragged = point(kBeside, kGrabButton);
    EXPECT_TRUE(dragged.pressed);
    ASSERT_TRUE(dragged.hit);
    EXPECT_NEAR(dragged.hit->at.x, kBeside.x, 1e-4) << "on the panel's plane";
    EXPECT_EQ(buttons_left(), 0u);
    EXPECT_FALSE(point(kBeside).hit);
    point(kBeside, kGrabButton);
    EXPECT_EQ(buttons_left(), kGrabButton);
}

TEST_F(PanelPointerTest, ADragOutlivesALostPoseAndNoneBeginsInOne) {
    point(kInside, kGrabButton);
    input_.devices[1].pose_valid = false;
    EXPECT_TRUE(update().pressed);
    EXPECT_NEAR(pointer_.touch().hit->at.x, kInside.x, 1e-4);
    EXPECT_EQ(buttons_left(), 0u);
    input_.devices[1].buttons = 0;
    EXPECT_FALSE(update().hit);
    input_.devices[1].buttons = kGrabButton;
    EXPECT_FALSE(update().pressed);
    EXPECT_EQ(buttons_left(), kGrabButton);
}

TEST_F(PanelPointerTest, AButtonThatItTookDoesNotReachTheWorldWhenThePanelGoes) {
    point(kInside, kGrabButton);
    touched_.panel.shown = false;
    EXPECT_FALSE(point(kInside, kGrabButton).pressed);
    EXPECT_EQ(buttons_left(), 0u);
    point(kInside);
    point(kInside, kGrabButton);
    EXPECT_EQ(buttons_left(), kGrabButton);
}

TEST_F(PanelPointerTest, TheButtonThatCallsThePanelIsNotTaken) {
    point(kInside, bit(WandButton::room_panel));
    EXPECT_EQ(buttons_left(), bit(WandButton::room_panel));
}

TEST_F(PanelPointerTest, TheStickScrollsOnThePanelUnlessItWasPushedBefore) {
    EXPECT_EQ(point(kInside, 0, 0.5f).scroll, 0.5);
    EXPECT_EQ(stick_left(), 0.0f);
    EXPECT_EQ(point(kBeside, 0, 0.5f).scroll, 0.0);
    EXPECT_EQ(stick_left(), 0.5f);
    EXPECT_EQ(point(kInside, 0, 0.5f).scroll, 0.0) << "the world has it until it rests";
    EXPECT_EQ(stick_left(), 0.5f);
    point(kInside, 0, 0.0f);
    EXPECT_EQ(point(kInside, 0, 0.5f).scroll, 0.5);
}

TEST_F(PanelPointerTest, TheMousesWheelScrollsWhereTheWandPoints) {
    point(kInside);
    input_.devices.push_back(mouse_dragged({1, 2, 0, 0, 0, 0, 3}));
    EXPECT_EQ(update().notches, 3.0);
    EXPECT_EQ(left_.find("mouse")->valuators, (std::vector<float>{1, 2, 0, 0, 0, 0, 0}));
    point(kBeside);
    input_.devices.push_back(mouse_dragged({1, 2, 0, 0, 0, 0, 3}));
    EXPECT_EQ(update().notches, 0.0);
    EXPECT_EQ(left_, input_);
}

TEST_F(PanelPointerTest, CarriedByItsTitleItStaysOnTheRayAndFacesTheEyes) {
    point(kTitle);
    const float distance = pointer_.touch().hit->distance;
    point(kTitle, kGrabButton);
    ASSERT_TRUE(pointer_.carried());
    for (const float turn : {0.1f, 0.2f, 0.3f, 0.3f, 0.3f, 0.3f}) { // and comes to rest
        touched_.panel.pose = *pointer_.carried();
        const glm::quat aim = glm::angleAxis(turn, glm::vec3(0, 1, 0));
        input_.devices[1].pose = Pose{kHand, aim};
        input_.devices[1].buttons = kGrabButton;
        update();
        ASSERT_TRUE(pointer_.carried());
        const glm::vec3 held = kHand + aim * glm::vec3(0, 0, -distance);
        const glm::vec3 z = pointer_.carried()->orientation * glm::vec3(0, 0, 1);
        const glm::vec3 to_eyes = glm::normalize(kStanding.position - pointer_.carried()->position);
        EXPECT_NEAR(glm::dot(z, to_eyes), 1, 1e-5);
        EXPECT_LT(glm::distance(place_on(*pointer_.carried(), kSize, kTitle), held), 0.005);
    }
    const glm::vec3 held = kHand + input_.devices[1].pose->orientation * glm::vec3(0, 0, -distance);
    EXPECT_LT(glm::distance(place_on(*pointer_.carried(), kSize, kTitle), held), 1e-3);
    input_.devices[1].buttons = 0;
    update();
    EXPECT_FALSE(pointer_.carried());
}

TEST_F(PanelPointerTest, AClickBelowTheTitleDoesNotCarryIt) {
    point(kInside, kGrabButton);
    point(kTitle, kGrabButton);
    EXPECT_FALSE(pointer_.carried());
}

} // namespace
} // namespace isochron::interaction
