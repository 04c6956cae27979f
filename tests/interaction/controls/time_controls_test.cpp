// Keys, wand and gamepad set the range that plays, how it plays, and bookmarks of times.
#include "tests/interaction/controls/control_desk.h"

#include <gmock/gmock.h>

namespace isochron::interaction {
namespace {

DeviceState pad_down(GamepadButton button) {
    return {"gamepad", std::nullopt, true, bit(button), {}};
}

TEST(TimeControls, ActionsBeyondThoseOfOldRecordingsHaveADeviceOfTheirOwn) {
    Desk desk;
    desk.settings.step = 2;
    desk.frame({keys_down(bit(Action::range_first))}); // a bit that the device of others has, too
    EXPECT_EQ(desk.settings.play_range, StepRange{});
    desk.tap(Action::range_first);
    EXPECT_EQ(desk.settings.play_range, (StepRange{2, {}}));
}

TEST(TimeControls, KeysSetTheRangeAndGoToItsEnds) {
    Desk desk;
    desk.settings.step = 1;
    desk.tap(Action::range_first);
    desk.settings.step = 3;
    EXPECT_EQ(desk.tap(Action::range_last).play_range, (StepRange{1, 3}));
    EXPECT_EQ(desk.tap(Action::first_step).step, 1u);
    EXPECT_EQ(desk.tap(Action::last_step).step, 3u);
    EXPECT_TRUE(desk.tap(Action::last_step).empty());
    desk.tap(Action::range_last);
    EXPECT_EQ(desk.settings.play_range, (StepRange{1, {}}));
    EXPECT_EQ(desk.tap(Action::range_all).play_range, StepRange{});
    EXPECT_EQ(desk.tap(Action::last_step).step, 4u);
    EXPECT_EQ(desk.tap(Action::first_step).step, 0u);
}

TEST(TimeControls, PlayingGoesToAndFroInTheRange) {
    Desk desk;
    desk.settings.play_range = {1, 3};
    desk.settings.step = 1;
    desk.tap(Action::ping_pong);
    desk.tap(bit(Action::play));
    std::vector<std::uint32_t> steps{1};
    for (int frame = 0; frame < 1200 && steps.size() < 6; ++frame) {
        desk.frame({head_at(kStanding)});
        if (desk.settings.step != steps.back())
            steps.push_back(desk.settings.step);
    }
    EXPECT_THAT(steps, testing::ElementsAre(1, 2, 3, 2, 1, 2));
    EXPECT_TRUE(desk.settings.playback.playing);
}

TEST(TimeControls, KeysLeaveOutStepsAndShiftDoesNot) {
    Desk desk;
    desk.tap(Action::skip_more);
    EXPECT_EQ(desk.settings.playback.every, 2u);
    EXPECT_EQ(desk.tap(bit(Action::step_forward)).step, 2u);
    EXPECT_EQ(desk.tap(bit(Action::step_forward) | bit(Action::shift)).step, 3u);
    for (int i = 0; i < 3; ++i)
        desk.tap(Action::skip_fewer);
    EXPECT_EQ(desk.settings.playback.every, 1u);
}

TEST(TimeControls, SpeedCountsInThreeUnits) {
    Desk desk;
    const std::size_t units = kNames<SpeedUnit>.size();
    for (std::size_t i = 1; i <= units; ++i) {
        desk.tap(Action::speed_unit);
        EXPECT_EQ(desk.settings.playback.unit, static_cast<SpeedUnit>(i % units));
    }
    EXPECT_NEAR(desk.settings.playback.speed, 1, 1e-9);
    desk.tap(Action::speed_unit);
    const double rate = desk.settings.playback.rate;
    desk.tap(bit(Action::faster));
    EXPECT_NEAR(desk.settings.playback.rate, 2 * rate, 1e-9);
}

TEST(TimeControls, TimesAreBookmarkedAndVisited) {
    Desk desk;
    desk.settings.step = 3;
    desk.tap(Action::save_time);
    desk.settings.step = 1;
    desk.tap(Action::save_time);
    EXPECT_THAT(desk.settings.bookmarks,
                testing::ElementsAre(Bookmark{"step 2", 1}, Bookmark{"step 4", 3}));
    desk.settings.playback.playing = true;
    EXPECT_EQ(desk.tap(Action::next_time).step, 3u);
    EXPECT_FALSE(desk.settings.playback.playing) << "it stays there";
    EXPECT_EQ(desk.tap(Action::next_time).step, 1u);
    EXPECT_EQ(desk.tap(Action::previous_time).step, 3u);
    desk.tap(Action::save_time);
    EXPECT_THAT(desk.settings.bookmarks, testing::ElementsAre(Bookmark{"step 2", 1}));
}

TEST(TimeControls, WandAndGamepadReachBookmarksAndTheRange) {
    Desk desk;
    desk.settings.step = 2;
    desk.frame({wand_at(kStanding, bit(WandButton::save_time))});
    desk.frame({pad_down(GamepadButton::down)});
    EXPECT_EQ(desk.settings.play_range, (StepRange{2, {}}));
    desk.settings.step = 4;
    desk.frame({pad_down(GamepadButton::up)});
    desk.frame({wand_at(kStanding, bit(WandButton::mark_range))});
    EXPECT_EQ(desk.settings.play_range, (StepRange{2, 4}));
    EXPECT_EQ(desk.settings.bookmarks.size(), 2u);
    EXPECT_EQ(desk.frame({wand_at(kStanding, bit(WandButton::next_time))}).step, 2u);
    EXPECT_EQ(desk.frame({pad_down(GamepadButton::left)}).step, 4u);
    EXPECT_EQ(desk.frame({pad_down(GamepadButton::right)}).step, 2u);
    EXPECT_EQ(desk.frame({wand_at(kStanding, bit(WandButton::previous_time))}).step, 4u);
}

TEST(TimeControls, NoStepsAreNoTrouble) {
    Desk desk;
    desk.times.clear();
    for (const Action action : {Action::first_step, Action::last_step, Action::next_time,
                                Action::ping_pong, Action::speed_unit, Action::skip_more})
        EXPECT_EQ(desk.tap(action).step, std::nullopt);
}

TEST(TimeControls, ArrowsGoFromAMomentToTheStepsAroundIt) {
    Desk desk;
    EXPECT_EQ(desk.tap(Action::between_steps).between, BetweenSteps::blend);
    desk.settings.step = 2;
    desk.settings.fraction = 1000;
    desk.tap(bit(Action::step_back));
    EXPECT_EQ(desk.settings.moment(), Moment(2));
    desk.settings.fraction = 1000;
    desk.tap(bit(Action::step_forward));
    EXPECT_EQ(desk.settings.moment(), Moment(3));
    EXPECT_EQ(desk.tap(Action::between_steps).between, BetweenSteps::hold);
}

DeviceState wand_pushing(float rate) {
    DeviceState wand = wand_at(kStanding, 0);
    wand.valuators = {0, 0, 0, 0, rate};
    return wand;
}

TEST(TimeControls, AWandPushesTimeBetweenStepsToTheEndsAndBack) {
    Desk desk;
    desk.tap(Action::between_steps);
    std::vector<Moment> seen{desk.settings.moment()};
    const auto push = [&](float rate, int frames) {
        for (int frame = 0; frame < frames; ++frame) {
            desk.frame({wand_pushing(rate)});
            if (desk.settings.moment() != seen.back())
                seen.push_back(desk.settings.moment());
        }
    };
    push(0.5f, 60);
    EXPECT_GT(seen.size(), 50u) << "every frame has its moment";
    EXPECT_GT(std::ranges::count_if(seen, [](const Moment& at) { return at.fraction > 0; }), 40);
    EXPECT_TRUE(std::ranges::is_sorted(seen, {}, [](const Moment& at) {
        return std::uint64_t{at.step} * kFractions + at.fraction;
    }));
    const Moment rests = desk.settings.moment();
    push(0, 60);
    EXPECT_EQ(desk.settings.moment(), rests);
    EXPECT_FALSE(desk.settings.playback.playing);
    push(1, 600);
    EXPECT_EQ(desk.settings.moment(), Moment(4)) << "the last step: it does not start over";
    push(-1, 600);
    EXPECT_EQ(desk.settings.moment(), Moment(0));
}

TEST(TimeControls, AWandPushesTimeByStepsWhereStepsAreHeldAndWithinTheRange) {
    Desk desk;
    desk.settings.play_range = {1, 3};
    desk.settings.step = 1;
    for (int frame = 0; frame < 600; ++frame)
        EXPECT_FALSE(desk.frame({wand_pushing(1)}).fraction);
    EXPECT_EQ(desk.settings.step, 3u);
    desk.tap(bit(Action::play)); // pushing ends playing
    desk.frame({wand_pushing(-1)});
    for (int frame = 0; frame < 600; ++frame)
        desk.frame({wand_pushing(-1)});
    EXPECT_EQ(desk.settings.step, 1u);
    EXPECT_FALSE(desk.settings.playback.playing);
}

DeviceState stick_at(float x) {
    DeviceState wand = wand_at(kStanding, 0);
    wand.valuators = {0, 0, 0, 0, 0, x};
    return wand;
}

TEST(TimeControls, AHeadsetsStickGoesThroughTheMomentsWhereStepsAreBlended) {
    Desk desk;
    desk.tap(Action::between_steps);
    std::vector<Moment> seen{desk.settings.moment()};
    for (int frame = 0; frame < 40; ++frame) {
        desk.frame({stick_at(0.5f)});
        EXPECT_GT(desk.settings.moment(), seen.back());
        seen.push_back(desk.settings.moment());
    }
    EXPECT_GT(std::ranges::count_if(seen, [](const Moment& at) { return at.fraction > 0; }), 30);
    for (int frame = 0; frame < 600; ++frame)
        desk.frame({stick_at(-1)});
    EXPECT_EQ(desk.settings.moment(), Moment(0));
}

TEST(TimeControls, AHeadsetsStickGoesAStepForEachPushWhereStepsAreHeld) {
    Desk desk;
    desk.settings.playback.loop = false;
    for (const std::uint32_t step : {1u, 2u, 3u}) {
        desk.frame({stick_at(1)});
        EXPECT_EQ(desk.settings.step, step);
        desk.frame({stick_at(1)}); // still held, not yet for so long that it repeats
        EXPECT_EQ(desk.settings.step, step);
        desk.frame({stick_at(0.3f)});
    }
    desk.frame({stick_at(-1)});
    EXPECT_EQ(desk.settings.moment(), Moment(2));
    for (int frame = 0; frame < 60; ++frame)
        desk.frame({stick_at(-1)});
    EXPECT_EQ(desk.settings.step, 0u) << "held, it repeats";
}

TEST(TimeControls, TimeThatIsHeldSetsNoFractions) {
    Desk desk;
    desk.tap(bit(Action::play));
    for (int frame = 0; frame < 300; ++frame)
        EXPECT_FALSE(desk.frame({head_at(kStanding)}).fraction);
    desk.settings.quality = QualityMode::paper; // which holds
    desk.tap(Action::between_steps);
    for (int frame = 0; frame < 300; ++frame)
        EXPECT_FALSE(desk.frame({head_at(kStanding)}).fraction);
}

TEST(TimeControls, ACommandWithAStepAloneIsThatStepItself) {
    Commands commands;
    commands.step = 3;
    commands.fraction = 77;
    Commands later;
    later.step = 5;
    merge(commands, later);
    EXPECT_EQ(commands.step, 5u);
    EXPECT_FALSE(commands.fraction);
}

} // namespace
} // namespace isochron::interaction
