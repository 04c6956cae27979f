// The haptic pulses of hands.
#include "app/loop/haptics.h"

#include "interaction/input/actions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace isochron::app {
namespace {

using interaction::WandButton;
using testing::ElementsAre;
using testing::Field;
using testing::IsEmpty;

interaction::InputState hand(const char* name, std::uint64_t buttons, bool tracked = true) {
    interaction::DeviceState state;
    state.name = name;
    state.pose = interaction::Pose{};
    state.pose_valid = tracked;
    state.buttons = buttons;
    return {interaction::Seconds(0), {state}};
}

TEST(Haptics, AGrabIsFeltOnceByItsHand) {
    Haptics haptics;
    EXPECT_THAT(haptics.update(hand("wand2", 0)), IsEmpty());
    EXPECT_THAT(haptics.update(hand("wand2", bit(WandButton::grab))),
                ElementsAre(Field(&interaction::HapticPulse::hand, "wand2")));
    EXPECT_THAT(haptics.update(hand("wand2", bit(WandButton::grab))), IsEmpty());
    EXPECT_THAT(haptics.update(hand("wand2", 0)), IsEmpty());
}

TEST(Haptics, TeleportingIsFeltWhenTheButtonIsLetGo) {
    Haptics haptics;
    EXPECT_THAT(haptics.update(hand("wand", bit(WandButton::teleport))), IsEmpty());
    EXPECT_THAT(haptics.update(hand("wand", 0)),
                ElementsAre(Field(&interaction::HapticPulse::hand, "wand")));
}

TEST(Haptics, AHandThatIsNotTrackedGrabsNothing) {
    Haptics haptics;
    EXPECT_THAT(haptics.update(hand("wand", bit(WandButton::grab), false)), IsEmpty());
}

} // namespace
} // namespace isochron::app
