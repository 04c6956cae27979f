// The wearer's head and hands as devices.
#include "tests/support/played_fixture.h"

#include "interaction/input/actions.h"

namespace isochron::stereo {
namespace {

using interaction::Action;
using interaction::Tracking;
using interaction::WandButton;
using interaction::WandValuator;

const Pose kRight{{0.2f, 1.1f, -0.4f}, glm::angleAxis(0.5f, glm::vec3(0, 1, 0))};
const Pose kLeft{{-0.3f, 1.2f, -0.3f}, glm::angleAxis(0.2f, glm::vec3(1, 0, 0))};

class HandsTest : public PlayedTest {
  protected:
    void take_controllers() {
        headset().right.present = headset().left.present = true;
        headset().right.aim = headset().right.grip = kRight;
        headset().left.aim = headset().left.grip = kLeft;
    }
    const interaction::DeviceState& device(const char* name) {
        const auto* found = input_.find(name);
        if (!found)
            throw std::runtime_error(std::string("no device ") + name);
        return *found;
    }
    float valuator(WandValuator which) {
        return device("wand").valuators.at(static_cast<std::size_t>(which));
    }
};

TEST_F(HandsTest, TheHeadIsWhereItWillBeWithVelocityAndTime) {
    headset().head = {{0.1f, 1.7f, 0.2f}, glm::angleAxis(0.4f, glm::vec3(0, 1, 0))};
    headset().head_velocity = {{0.3, 0.1, -0.2}, {0.0, 0.5, 0.1}};
    connect();
    settle();
    const auto& head = device("head");
    EXPECT_EQ(head.tracking(), Tracking::tracked);
    EXPECT_LT(glm::distance(head.pose->position, headset().head.position), 1e-6f);
    EXPECT_GT(std::abs(glm::dot(head.pose->orientation, headset().head.orientation)), 0.999999f);
    EXPECT_LT(glm::distance(head.velocity->linear, glm::dvec3(0.3, 0.1, -0.2)), 1e-6);
    EXPECT_LT(glm::distance(head.velocity->angular, glm::dvec3(0.0, 0.5, 0.1)), 1e-6);
    EXPECT_EQ(head.measured, now_);
    EXPECT_NEAR(head.device_time->count(),
                1e-9 * static_cast<double>(headset().frames.back().display_time), 1e-6);
}

TEST_F(HandsTest, AHeadThatIsLostIsHeldAndThenLost) {
    connect();
    settle();
    const auto last = device("head").pose;
    headset().head_valid = false;
    headset().head.position.x += 1;
    for (int i = 0; i < 12; ++i)
        frame();
    EXPECT_EQ(device("head").tracking(), Tracking::held);
    EXPECT_EQ(device("head").pose, last);
    now_ += Seconds(1.5);
    frame();
    EXPECT_EQ(device("head").tracking(), Tracking::lost);
    headset().head_valid = true;
    for (int i = 0; i < 60; ++i)
        frame();
    EXPECT_EQ(device("head").tracking(), Tracking::tracked);
}

TEST_F(HandsTest, HandsAppearWithTheirControllers) {
    connect();
    settle();
    EXPECT_EQ(input_.find("wand"), nullptr) << "the mouse may have it";
    take_controllers();
    frame();
    EXPECT_LT(glm::distance(device("wand").pose->position, kRight.position), 1e-6f);
    EXPECT_LT(glm::distance(device("wand2").pose->position, kLeft.position), 1e-6f);
    EXPECT_EQ(device("wand").tracking(), Tracking::tracked);
}

TEST_F(HandsTest, HandsThatMoveAtOnceAreStatedWhereTheRuntimeSaysExactly) {
    take_controllers();
    connect();
    settle();
    for (int i = 0; i < 50; ++i) {
        const float turn = 0.1f * static_cast<float>(i);
        headset().right.aim.position = kRight.position + 0.2f * glm::vec3(std::cos(turn), 0, turn);
        headset().left.aim.position = kLeft.position - 0.2f * glm::vec3(turn, std::sin(turn), 0);
        frame();
        EXPECT_LT(glm::distance(device("wand").pose->position, headset().right.aim.position),
                  1e-6f);
        EXPECT_LT(glm::distance(device("wand2").pose->position, headset().left.aim.position),
                  1e-6f);
    }
}

TEST_F(HandsTest, AHandThatIsGuessedAtMovesNothing) {
    take_controllers();
    connect();
    settle();
    headset().right.tracked = false;
    for (int i = 0; i < 12; ++i)
        frame();
    EXPECT_EQ(device("wand").tracking(), Tracking::held);
}

TEST_F(HandsTest, ARecenteredRoomIsBelievedAtOnce) {
    take_controllers();
    connect();
    settle();
    headset().happens(Happening::recenter);
    frame();
    headset().head.position.z += 3.0f;
    frame();
    EXPECT_LT(glm::distance(device("head").pose->position, headset().head.position), 1e-5f);
}

TEST_F(HandsTest, TheLeftHandPointsForTheLeftHanded) {
    take_controllers();
    options_.left_handed = true;
    headset().left.inputs["x/click"] = 1;
    connect();
    settle();
    EXPECT_LT(glm::distance(device("wand").pose->position, kLeft.position), 1e-6f);
    EXPECT_TRUE(device("wand").buttons & bit(WandButton::teleport));
}

TEST_F(HandsTest, NothingStaysPressedWithoutTheInput) {
    take_controllers();
    headset().right.inputs["squeeze/value"] = 1;
    connect();
    settle();
    ASSERT_TRUE(device("wand").buttons & bit(WandButton::grab));
    headset().happens(Happening::cover);
    frame();
    frame();
    EXPECT_EQ(device("wand").buttons, 0u);
}

TEST_F(HandsTest, PulsesReachTheHandTheyAreFor) {
    take_controllers();
    connect();
    settle();
    client_->vibrate("wand", Seconds(0.04), 0.8f);
    client_->vibrate("wand2", Seconds(0.02), 7.0f);
    client_->vibrate("head", Seconds(0.02), 1.0f);
    ASSERT_EQ(headset().pulses.size(), 2u);
    EXPECT_EQ(headset().pulses[0].hand, "/user/hand/right");
    EXPECT_EQ(headset().pulses[0].nanoseconds, 40'000'000);
    EXPECT_FLOAT_EQ(headset().pulses[0].amplitude, 0.8f);
    EXPECT_EQ(headset().pulses[1].hand, "/user/hand/left");
    EXPECT_FLOAT_EQ(headset().pulses[1].amplitude, 1.0f);
}

/// One control of a controller, and what it comes to.
struct Control {
    const char* profile;
    bool left;
    const char* input;
    std::uint64_t wand = 0, wand2 = 0;
    interaction::ActionSet keys = {};
    std::optional<WandValuator> valuator = std::nullopt;
};
constexpr const char* kTouch = "/interaction_profiles/oculus/touch_controller";
constexpr const char* kIndex = "/interaction_profiles/valve/index_controller";
constexpr const char* kVive = "/interaction_profiles/htc/vive_controller";
constexpr const char* kMixed = "/interaction_profiles/microsoft/motion_controller";
constexpr const char* kSimple = "/interaction_profiles/khr/simple_controller";

const std::vector<Control> kControls{
    {kTouch, false, "squeeze/value", bit(WandButton::grab)},
    {kTouch, true, "squeeze/value", 0, bit(WandButton::grab)},
    {kTouch, false, "trigger/value", bit(WandButton::fly)},
    {kTouch, false, "a/click", bit(WandButton::teleport)},
    {kTouch, false, "b/click", bit(WandButton::recenter)},
    {kTouch, false, "thumbstick/click", 0, 0, bit(Action::pick)},
    {kTouch, true, "thumbstick/click", 0, 0, bit(Action::next_view)},
    {kTouch, false, "thumbstick/y", 0, 0, 0, WandValuator::fly},
    {kTouch, false, "thumbstick/x", 0, 0, 0, WandValuator::turn},
    {kTouch, true, "thumbstick/y", 0, 0, 0, WandValuator::isovalue},
    {kTouch, true, "thumbstick/x", 0, 0, 0, WandValuator::step},
    {kTouch, true, "trigger/value", 0, 0, bit(Action::play)},
    {kTouch, true, "x/click", 0, 0, bit(Action::reverse)},
    {kTouch, true, "y/click", 0, 0, bit(Action::room_panel)},
    {kIndex, false, "squeeze/value", bit(WandButton::grab)},
    {kIndex, false, "a/click", bit(WandButton::teleport)},
    {kIndex, true, "b/click", 0, 0, bit(Action::room_panel)},
    {kIndex, true, "thumbstick/y", 0, 0, 0, WandValuator::isovalue},
    {kVive, false, "squeeze/click", bit(WandButton::grab)},
    {kVive, false, "trackpad/click", bit(WandButton::teleport)},
    {kVive, false, "trackpad/x", 0, 0, 0, WandValuator::turn},
    {kVive, true, "menu/click", 0, 0, bit(Action::room_panel)},
    {kVive, true, "trackpad/click", 0, 0, bit(Action::pick)},
    {kMixed, false, "trigger/value", bit(WandButton::fly)},
    {kMixed, false, "thumbstick/y", 0, 0, 0, WandValuator::fly},
    {kMixed, true, "squeeze/click", 0, bit(WandButton::grab)},
    {kSimple, false, "select/click", bit(WandButton::grab)},
    {kSimple, true, "select/click", 0, bit(WandButton::grab)},
    {kSimple, false, "menu/click", bit(WandButton::teleport)},
    {kSimple, true, "menu/click", 0, 0, bit(Action::play)},
};

TEST_F(HandsTest, EveryControlDoesWhatItIsFor) {
    for (const Control& control : kControls) {
        SCOPED_TRACE(std::string(control.profile) + (control.left ? " left " : " right ") +
                     control.input);
        headset().reset();
        take_controllers();
        headset().profile = control.profile;
        connect();
        settle();
        (control.left ? headset().left : headset().right).inputs[control.input] = 1;
        frame();
        EXPECT_EQ(device("wand").buttons, control.wand);
        EXPECT_EQ(device("wand2").buttons, control.wand2);
        const auto* keys = input_.find("keys");
        EXPECT_EQ(keys ? keys->actions : interaction::ActionSet(), control.keys);
        for (const auto which : {WandValuator::isovalue, WandValuator::fly, WandValuator::turn,
                                 WandValuator::time, WandValuator::step})
            EXPECT_EQ(valuator(which), which == control.valuator ? 1.0f : 0.0f);
        EXPECT_EQ(codes(), std::vector<std::string>());
        client_->leave();
        client_->detach();
        client_.reset();
    }
}

} // namespace
} // namespace isochron::stereo
