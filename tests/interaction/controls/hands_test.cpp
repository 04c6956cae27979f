// Navigation in rooms: two hands, flying by valuator, snap turns, teleport, viewpoints.
#include "interaction/navigation/comfort.h"
#include "interaction/navigation/navigator.h"

#include "tests/interaction/controls/control_desk.h"
#include "tests/support/test_seed.h"

#include <cmath>
#include <limits>

namespace isochron::interaction {
namespace {

constexpr std::uint64_t kGrab = bit(WandButton::grab);
constexpr double kTurn = 0.523598776; ///< 30 degrees

DeviceState other_at(const Pose& pose, std::uint64_t buttons = kGrab) {
    return {"wand2", pose, true, buttons, {}};
}

glm::vec3 random_place(Random& random) {
    return {uniform(random, -0.5, 0.5), uniform(random, 0.8, 1.8), uniform(random, -0.8, 0)};
}

/// A wand with all four valuators.
DeviceState wand_with(std::vector<float> valuators, const Pose& pose = kStanding) {
    return {"wand", pose, true, 0, std::move(valuators)};
}

TEST(Hands, WhatTwoHandsHoldStaysInThem) {
    Random random(test_seed());
    for (int round = 0; round < 50; ++round) {
        Desk desk;
        Pose left{random_place(random), random_rotation(random)};
        Pose right{left.position + glm::vec3(0.3f, 0, 0), random_rotation(random)};
        desk.frame({wand_at(right, kGrab), other_at(left)});
        const glm::dvec3 in_right = physical(desk.volume(), right.position);
        const glm::dvec3 in_left = physical(desk.volume(), left.position);
        for (int frame = 0; frame < 100; ++frame) {
            do {
                left = {random_place(random), random_rotation(random)};
                right = {random_place(random), random_rotation(random)};
            } while (glm::length(left.position - right.position) < 0.05f);
            desk.frame({wand_at(right, kGrab), other_at(left)});
            expect_near(transform(desk.volume(), in_right), right.position, 1e-6);
            expect_near(transform(desk.volume(), in_left), left.position, 1e-6);
        }
    }
}

TEST(Hands, OneHandAfterTwoAndTwoAfterOneMakeNoLeap) {
    Desk desk;
    Pose left{{-0.2f, 1.2f, -0.4f}, {1, 0, 0, 0}}, right{{0.2f, 1.2f, -0.4f}, {1, 0, 0, 0}};
    desk.frame({wand_at(right, kGrab), other_at(left, 0)});
    EXPECT_TRUE(desk.frame({wand_at(right, kGrab), other_at(left)}).empty());
    right.position.x = 0.6f;
    desk.frame({wand_at(right, kGrab), other_at(left)});
    EXPECT_NEAR(desk.volume().scale, 0.02, 1e-6);
    EXPECT_TRUE(desk.frame({wand_at(right), other_at(left)}).empty()) << "now the left one alone";
    const glm::dvec3 before = desk.volume().translation;
    left.position.y += 0.25f;
    desk.frame({wand_at(right), other_at(left)});
    expect_near(desk.volume().translation - before, {0, 0.25, 0}, 1e-6);
    EXPECT_NEAR(desk.volume().scale, 0.02, 1e-6);
}

TEST(Hands, ScaleBetweenHandsIsClampedAndNeverNaN) {
    const float nan = std::nanf(""), inf = std::numeric_limits<float>::infinity();
    for (const glm::vec3 far : {glm::vec3(0), glm::vec3(1e-30f, 0, 0), glm::vec3(1e30f, 0, 0),
                                glm::vec3(3e4f, 0, 0), glm::vec3(nan, 0, 0), glm::vec3(0, inf, 0)})
        for (const float start : {0.0f, 0.005f, 0.3f}) {
            Desk desk;
            const Pose left{{0, 1, 0}, {1, 0, 0, 0}};
            desk.frame({wand_at({left.position + glm::vec3(start, 0, 0), {1, 0, 0, 0}}, kGrab),
                        other_at(left)});
            for (int frame = 0; frame < 3; ++frame) {
                desk.frame({wand_at({left.position + far, {1, 0, 0, 0}}, kGrab), other_at(left)});
                ASSERT_TRUE(is_valid(desk.volume())) << far.x << ' ' << start;
                EXPECT_GE(desk.volume().scale, 0.01e-3 * (1 - 1e-12));
                EXPECT_LE(desk.volume().scale, 0.01e3 * (1 + 1e-12));
                EXPECT_NEAR(glm::length(desk.volume().rotation), 1, 1e-9);
            }
        }
}

TEST(Hands, AHandThatIsOnlyHeldMovesNothing) {
    Desk desk;
    DeviceState left = other_at({{-0.2f, 1.2f, -0.4f}, {1, 0, 0, 0}});
    Pose right{{0.2f, 1.2f, -0.4f}, {1, 0, 0, 0}};
    desk.frame({wand_at(right, kGrab), left});
    left.pose_valid = false;
    left.pose->position.x = -5;
    EXPECT_TRUE(desk.frame({wand_at(right, kGrab), left}).empty());
    left.pose_valid = true;
    EXPECT_TRUE(desk.frame({wand_at(right, kGrab), left}).empty());
}

TEST(Navigator, TheFlyValuatorFliesBothWays) {
    for (const float rate : {1.0f, -0.5f}) {
        Desk desk;
        desk.frame({});
        const Pose wand{{0.3f, 1.2f, 0}, glm::angleAxis(1.0f, glm::vec3(0, 1, 0))};
        const glm::dvec3 before = desk.volume().translation;
        for (int frame = 0; frame < 30; ++frame)
            desk.frame({wand_with({0, 0, rate, 0}, wand)});
        const glm::dvec3 direction = glm::dquat(wand.orientation) * glm::dvec3(0, 0, -1);
        expect_near(desk.volume().translation - before, -0.5 * rate * direction, 1e-6);
    }
}

TEST(Navigator, SnapTurnsComeOnceAndTurnAboutTheViewer) {
    Desk desk;
    const Pose head{{0.5f, 1.7f, 0.3f}, {1, 0, 0, 0}};
    const auto deflect = [&](float value) {
        desk.frame({head_at(head), wand_with({0, 0, 0, value})});
    };
    const glm::dvec3 here = physical(desk.volume(), head.position);
    const glm::dquat before = desk.volume().rotation;
    const auto turned_by = [&] {
        return rotation_between(glm::quat(before), glm::quat(desk.volume().rotation)).y;
    };
    for (const float value : {0.5f, 0.8f, 1.0f, 0.8f, 0.5f, 0.9f})
        deflect(value);
    EXPECT_NEAR(turned_by(), kTurn, 1e-5) << "a viewer who turns right sees the volume go left";
    deflect(0.1f);
    deflect(0.9f);
    EXPECT_NEAR(turned_by(), 2 * kTurn, 1e-5);
    desk.frame({head_at(head), keys_down(bit(Action::turn_left))});
    desk.frame({head_at(head), keys_down(bit(Action::turn_left))});
    EXPECT_NEAR(turned_by(), kTurn, 1e-5) << "and a held key turns once";
    expect_near(transform(desk.volume(), here), head.position, 1e-5);
}

TEST(Navigator, TeleportBringsThePointedPlaceToTheFeet) {
    Desk desk;
    const Pose head{{0.5f, 1.7f, 0.3f}, {1, 0, 0, 0}};
    // From 1 m up, down by 45 degrees: 1 m ahead.
    const Pose wand{{0.2f, 1.0f, 0}, glm::angleAxis(-0.785398163f, glm::vec3(1, 0, 0))};
    ASSERT_TRUE(floor_point(wand, 20));
    expect_near(*floor_point(wand, 20), {0.2, 0, -1}, 1e-6);
    const glm::dvec3 place = physical(desk.volume(), {0.2, 0, -1});
    for (int frame = 0; frame < 3; ++frame)
        EXPECT_TRUE(desk.frame({head_at(head), wand_at(wand, bit(WandButton::teleport))}).empty());
    ASSERT_TRUE(teleport_target({Seconds(0), {wand_at(wand, bit(WandButton::teleport))}}));
    desk.frame({head_at(head), wand_at(wand)});
    expect_near(transform(desk.volume(), place), {0.5, 0, 0.3}, 1e-6);
    EXPECT_FALSE(teleport_target({Seconds(0), {wand_at(wand)}}));
    EXPECT_TRUE(desk.frame({head_at(head), wand_at(wand)}).empty());

    // Up, level, too flat for the reach, or out of sight: nowhere.
    for (const float pitch : {0.5f, 0.0f, -0.01f}) {
        const Pose elsewhere{wand.position, glm::angleAxis(pitch, glm::vec3(1, 0, 0))};
        EXPECT_FALSE(floor_point(elsewhere, 20));
        desk.frame({head_at(head), wand_at(elsewhere, bit(WandButton::teleport))});
        EXPECT_TRUE(desk.frame({head_at(head), wand_at(elsewhere)}).empty());
    }
    DeviceState lost = wand_at(wand, bit(WandButton::teleport));
    lost.pose_valid = false;
    desk.frame({head_at(head), lost});
    EXPECT_TRUE(desk.frame({head_at(head), wand_at(wand)}).empty());
}

TEST(Navigator, TeleportFollowsTheEyesRayUnderTheCursor) {
    const Pose eye{{0, 1.6f, 0}, glm::angleAxis(-0.6f, glm::vec3(1, 0, 0))};
    DeviceState pointer{.name = "pointer", .pose = eye, .valuators = {}};
    const Pose wand{{0.2f, 1.2f, 0}, glm::angleAxis(-1.2f, glm::vec3(1, 0, 0))};
    const auto target =
        teleport_target({Seconds(0), {wand_at(wand, bit(WandButton::teleport)), pointer}});
    ASSERT_TRUE(target);
    expect_near(*target, *floor_point(eye, 20), 1e-9);
}

/// From anywhere to anywhere: who does not stand in the data sees them ahead.
TEST(Navigator, ATeleportNeverLeavesTheDataOutOfSight) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> place(-6, 6), turn(-3.1f, 3.1f), down(-1.4f, -0.2f);
    int turned = 0;
    for (int i = 0; i < 500; ++i) {
        Desk desk;
        const Pose head{{place(random), 1.7f, place(random)},
                        glm::angleAxis(turn(random), glm::vec3(0, 1, 0))};
        const Pose wand{head.position + glm::vec3(0, -0.5f, 0),
                        glm::angleAxis(turn(random), glm::vec3(0, 1, 0)) *
                            glm::angleAxis(down(random), glm::vec3(1, 0, 0))};
        desk.frame({head_at(head), wand_at(wand, bit(WandButton::teleport))});
        const Similarity before = desk.volume();
        desk.frame({head_at(head), wand_at(wand)});
        glm::dvec3 way = desk.center() - glm::dvec3(head.position);
        way.y = 0;
        if (glm::length(way) < 0.75 * 0.6)
            continue; // in the data
        const double off = std::remainder(std::atan2(-way.x, -way.z) - heading(head), 6.283185307);
        EXPECT_LT(std::abs(off), 0.61) << i;
        turned += glm::length(before.rotation - desk.volume().rotation) > 1e-6;
    }
    EXPECT_GT(turned, 100);
}

TEST(Navigator, RecenterPutsTheVolumeAheadOfTheViewer) {
    Desk desk;
    const Pose head{{2, 1.8f, -3}, glm::angleAxis(1.57079633f, glm::vec3(0, 1, 0))};
    desk.frame({head_at(head)});
    desk.frame({head_at(head), keys_down(bit(Action::recenter))});
    // What was 1.5 m ahead (-Z) and 0.1 m to the right is now 1.5 m to -X and 0.1 m to -Z.
    expect_near(desk.volume().translation, {2 - 1.5, 1.3, -3 - 0.1}, 1e-6);
    EXPECT_NEAR(desk.volume().scale, desk.context.series.home.scale, 1e-12);
}

TEST(Navigator, ViewpointsAreSavedUnderNewNamesAndComeBackInTurn) {
    Desk desk;
    const ActionSet save = bit(Action::save_view), next = bit(Action::next_view);
    EXPECT_TRUE(desk.tap(next).empty()) << "there are none yet";
    const Similarity first = desk.volume();
    ASSERT_EQ(desk.tap(save).views->size(), 1u);
    EXPECT_EQ(desk.notes(),
              (std::vector<std::string>{"no viewpoint is saved: B saves this one",
                                        "viewpoint view-1 saved: N goes there"}));
    desk.frame({wand_with({0, 0, 1, 0})}, 0.1);
    desk.frame({wand_with({0, 0, 1, 0})}, 0.1);
    const Similarity second = desk.volume();
    ASSERT_NE(first, second);
    desk.tap(save);
    ASSERT_EQ(desk.settings.views.size(), 2u);
    EXPECT_EQ(desk.settings.views[0].name, "view-1");
    EXPECT_EQ(desk.settings.views[1].name, "view-2");
    desk.tap(next);
    EXPECT_EQ(desk.volume(), first);
    desk.tap(next);
    EXPECT_EQ(desk.volume(), second);
    desk.frame({wand_with({0, 0, 1, 0})}, 0.1);
    desk.tap(next);
    EXPECT_EQ(desk.volume(), first) << "from elsewhere, the first one";
    for (int i = 0; i < 70; ++i)
        desk.tap(save);
    EXPECT_EQ(desk.settings.views.size(), kMostViews);
}

TEST(Navigator, TheGridIsSwitched) {
    Desk desk;
    EXPECT_EQ(desk.tap(bit(Action::grid)).grid, true);
    EXPECT_EQ(desk.tap(bit(Action::grid)).grid, false);
}

TEST(Hands, NoMotionWhateverMakesTheVolumeInvalid) {
    Random random(test_seed());
    const float inf = std::numeric_limits<float>::infinity();
    const float odd[] = {std::nanf(""), inf, -inf, 1e38f, -1e38f, 0.0f, 1e-45f, 0.5f, 1.0f, -1.0f};
    const auto any = [&] { return odd[random() % std::size(odd)]; };
    const auto hand = [&]() -> Pose {
        if (random() % 8 == 0)
            return {{any(), any(), any()}, glm::quat(any(), any(), any(), any())};
        return {random_place(random), random_rotation(random)};
    };
    for (int round = 0; round < tries(200); ++round) {
        Desk desk;
        for (int frame = 0; frame < 100; ++frame) {
            DeviceState wand = wand_with({any(), any(), any(), any()}, hand());
            wand.buttons = random();
            desk.frame({head_at(hand()),
                        wand,
                        other_at(hand(), random()),
                        keys_down(std::uint64_t{random()} << 32 | random()),
                        {"gamepad", std::nullopt, true, random(), {any(), any(), any(), any()}}},
                       uniform(random, 0, 1));
            ASSERT_TRUE(is_valid(desk.volume())) << "frame " << frame;
            ASSERT_NEAR(glm::length(desk.volume().rotation), 1.0, 1e-9);
            ASSERT_GE(desk.volume().scale, 0.01e-3 * (1 - 1e-9));
            ASSERT_LE(desk.volume().scale, 0.01e3 * (1 + 1e-9));
            ASSERT_LE(desk.settings.views.size(), kMostViews);
        }
    }
}

/// Frames at 60 Hz with a head that is tracked, lost, or not there.
class Seat {
  public:
    ComfortState frame(const Similarity& volume, Tracking tracking = Tracking::tracked) {
        now_ += Seconds(1.0 / 60);
        DeviceState head = head_at(kStanding);
        head.pose_valid = tracking == Tracking::tracked;
        head.pose_lost = tracking == Tracking::lost;
        return comfort_.update({now_, {head}}, volume);
    }
    ComfortState frames(int count, const Similarity& volume, Tracking tracking) {
        ComfortState state;
        for (int i = 0; i < count; ++i)
            state = frame(volume, tracking);
        return state;
    }

  private:
    Comfort comfort_{ComfortOptions{.vignette = true}};
    Seconds now_{0};
};

TEST(Comfort, TheVignetteClosesWhileFlyingAndOpensAfter) {
    Seat seat;
    Similarity volume{{0, 1, -2}, {1, 0, 0, 0}, 0.01};
    seat.frame(volume);
    ComfortState state;
    for (int i = 0; i < 12; ++i) {
        volume = moved(volume, {0, 0, 3.0 / 60});
        const ComfortState next = seat.frame(volume);
        EXPECT_GE(next.vignette, state.vignette);
        EXPECT_LE(next.vignette - state.vignette, 0.12) << "it closes gently";
        state = next;
    }
    EXPECT_EQ(state.vignette, 1);
    EXPECT_EQ(seat.frames(12, volume, Tracking::tracked).vignette, 0);
    // Slowly is no flying; turning the volume about the viewer is.
    for (int i = 0; i < 12; ++i) {
        volume = moved(volume, {0, 0, 0.3 / 60});
        EXPECT_EQ(seat.frame(volume).vignette, 0);
    }
    for (int i = 0; i < 12; ++i) {
        volume = turned(volume, kStanding.position, {0, 1, 0}, 3.0 / 60);
        state = seat.frame(volume);
    }
    EXPECT_EQ(state.vignette, 1);
}

TEST(Comfort, ThePictureFadesOnceTheHeadIsLostAndComesBack) {
    Seat seat;
    const Similarity volume;
    EXPECT_EQ(seat.frames(60, volume, Tracking::held).fade, 0);
    const double soon = seat.frames(15, volume, Tracking::lost).fade;
    EXPECT_NEAR(soon, 0.5, 0.02);
    EXPECT_EQ(seat.frames(60, volume, Tracking::lost).fade, 1);
    EXPECT_LT(seat.frames(1, volume, Tracking::tracked).fade, 1);
    EXPECT_EQ(seat.frames(60, volume, Tracking::tracked).fade, 0);
}

} // namespace
} // namespace isochron::interaction
