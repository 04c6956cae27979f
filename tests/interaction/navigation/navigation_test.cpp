// Devices move the volume: orbit, move, scale, fly, grab, reset.
#include "interaction/navigation/axis_views.h"
#include "tests/interaction/controls/control_desk.h"
#include "tests/support/test_seed.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <set>

namespace isochron::interaction {
namespace {

TEST(Controls, RestChangesNothing) {
    Desk desk;
    for (int frame = 0; frame < 10; ++frame)
        EXPECT_TRUE(desk.frame({head_at(kStanding), wand_at(kStanding), keys_down(0),
                                mouse_dragged(std::vector<float>(kMouseValuators, 0.0f))})
                        .empty());
    EXPECT_TRUE(desk.frame({}).empty());
}

TEST(Controls, OrbitKeepsTheCenterAndTheSize) {
    for (unsigned seed = 0; seed < 50; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Random random(seed);
        Desk desk;
        const glm::dvec3 center = desk.center();
        const Pose head{{float(uniform(random, -1, 1)), 1.5f, 0.3f}, random_rotation(random)};
        for (int frame = 0; frame < 100; ++frame)
            desk.frame({head_at(head), mouse_dragged({float(uniform(random, -0.2, 0.2)),
                                                      float(uniform(random, -0.2, 0.2))})});
        expect_near(desk.center(), center);
        EXPECT_NEAR(desk.volume().scale, 0.01, 1e-12);
        EXPECT_NEAR(glm::length(desk.volume().rotation), 1.0, 1e-12);
    }
}

TEST(Controls, OrbitTurnsTheFrontWithTheCursor) {
    Desk desk;
    const glm::dvec3 front = physical(desk.volume(), desk.center() + glm::dvec3(0, 0, 0.3));
    desk.frame({head_at(kStanding), mouse_dragged({0.1f, 0.0f})});
    EXPECT_GT(transform(desk.volume(), front).x, desk.center().x + 0.05);
    desk.frame({head_at(kStanding), mouse_dragged({-0.1f, 0.1f})});
    EXPECT_LT(transform(desk.volume(), front).y, desk.center().y - 0.05);
}

TEST(Controls, MovingKeepsTheCenterUnderTheCursor) {
    for (const bool by_shift : {false, true}) {
        Desk desk;
        const glm::dvec3 before = desk.center();
        const double distance = glm::length(before - glm::dvec3(kStanding.position));
        if (by_shift)
            desk.frame(
                {head_at(kStanding), keys_down(bit(Action::shift)), mouse_dragged({0.1f, 0.2f})});
        else
            desk.frame({head_at(kStanding), mouse_dragged({0, 0, 0, 0, 0.1f, 0.2f})});
        const double height = 2 * distance * std::tan(0.45);
        expect_near(desk.center() - before, {0.1 * height, -0.2 * height, 0}, 1e-3);
        EXPECT_EQ(desk.volume().rotation, desk.context.series.home.rotation);
    }
}

TEST(Controls, WheelScalesAboutTheCenterWithinBounds) {
    Desk desk;
    const glm::dvec3 center = desk.center();
    std::vector<float> wheel(kMouseValuators, 0.0f);
    wheel[kMouseWheel] = 1;
    desk.frame({mouse_dragged(wheel)});
    EXPECT_NEAR(desk.volume().scale, 0.011, 1e-12);
    for (const float notches : {50.0f, -50.0f, 1e30f, -1e30f}) {
        wheel[kMouseWheel] = notches;
        for (int i = 0; i < 20; ++i)
            desk.frame({mouse_dragged(wheel)});
        EXPECT_GE(desk.volume().scale, 0.01e-3 * (1 - 1e-12));
        EXPECT_LE(desk.volume().scale, 0.01e3 * (1 + 1e-12));
        expect_near(desk.center(), center, 1e-6);
    }
}

TEST(Controls, TheScaleValuatorDoublesInASecond) {
    for (const int rate : {20, 60, 144}) {
        Desk desk;
        desk.frame({});
        for (int frame = 0; frame < rate; ++frame)
            desk.frame({wand_at(kStanding, 0, 0, 1)}, 1.0 / rate);
        EXPECT_NEAR(desk.volume().scale, 0.02, 1e-6);
    }
}

TEST(Controls, FlyingMovesTheVolumeAgainstTheWand) {
    Desk desk;
    desk.frame({});
    const Pose wand{{0.3f, 1.2f, 0}, glm::angleAxis(1.0f, glm::vec3(0, 1, 0))};
    const glm::dvec3 before = desk.volume().translation;
    for (int frame = 0; frame < 30; ++frame)
        desk.frame({wand_at(wand, bit(WandButton::fly))});
    const glm::dvec3 direction = glm::dquat(wand.orientation) * glm::dvec3(0, 0, -1);
    expect_near(desk.volume().translation - before, -0.5 * direction, 1e-6);
}

TEST(Controls, AGrabbedVolumeKeepsItsPlaceInTheHand) {
    for (unsigned seed = 0; seed < 50; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Random random(seed);
        Desk desk;
        Pose wand{{0.2f, 1.3f, -0.4f}, random_rotation(random)};
        desk.frame({wand_at(wand, bit(WandButton::grab))});
        const glm::dmat4 in_hand =
            glm::inverse(glm::dmat4(room_from(wand))) * matrix(desk.volume());
        for (int frame = 0; frame < 200; ++frame) {
            wand = {{float(uniform(random, -1, 1)), float(uniform(random, 0, 2)), 0},
                    random_rotation(random)};
            desk.frame({wand_at(wand, bit(WandButton::grab))});
        }
        const glm::dmat4 now = glm::inverse(glm::dmat4(room_from(wand))) * matrix(desk.volume());
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j)
                EXPECT_NEAR(now[i][j], in_hand[i][j], 1e-5);
        EXPECT_EQ(desk.volume().scale, 0.01);
        const Similarity let_go = desk.volume();
        wand.position.x += 1;
        desk.frame({wand_at(wand)});
        EXPECT_EQ(desk.volume(), let_go);
    }
}

TEST(Controls, AWandThatIsLostWhileGrabbingDoesNotThrowTheVolume) {
    Desk desk;
    DeviceState wand = wand_at(kStanding, bit(WandButton::grab));
    desk.frame({wand});
    wand.pose_valid = false;
    wand.pose->position.x = 2;
    EXPECT_TRUE(desk.frame({wand}).empty());
    wand.pose_valid = true;
    EXPECT_TRUE(desk.frame({wand}).empty());
    wand.pose->position.x = 2.1f;
    desk.frame({wand});
    expect_near(desk.volume().translation - desk.context.series.home.translation, {0.1, 0, 0},
                1e-6);
}

TEST(Controls, ScalingWhileGrabbingKeepsBoth) {
    Desk desk;
    Pose hand = kStanding;
    desk.frame({wand_at(hand, bit(WandButton::grab))});
    for (int frame = 0; frame < 60; ++frame)
        desk.frame({wand_at(hand, bit(WandButton::grab), 0, 1)});
    EXPECT_NEAR(desk.volume().scale, 0.02, 1e-6);
    const glm::dvec3 before = desk.volume().translation;
    hand.position.y += 0.5f;
    desk.frame({wand_at(hand, bit(WandButton::grab))});
    expect_near(desk.volume().translation - before, {0, 0.5, 0}, 1e-6);
}

TEST(Controls, ResetReturnsHome) {
    Desk desk;
    desk.frame({head_at(kStanding), mouse_dragged({0.3f, 0.2f, 0.1f, 0.1f, 0, 0, 3})});
    ASSERT_NE(desk.volume(), desk.context.series.home);
    desk.tap(bit(Action::reset));
    EXPECT_EQ(desk.volume(), desk.context.series.home);
    EXPECT_FALSE(desk.tap(bit(Action::reset)).room_from_physical);
}

TEST(Controls, ResetLeadsBackToTheStartInEverything) {
    Desk desk;
    Commands start;
    start.isovalue = 12;
    start.orthographic = false;
    start.clip = ClipPlane{};
    desk.context.ways.start = &start;
    const Commands commands = desk.tap(bit(Action::reset));
    EXPECT_EQ(commands.isovalue, 12);
    EXPECT_EQ(commands.orthographic, false);
    EXPECT_TRUE(commands.clip);
    EXPECT_FALSE(desk.frame({head_at(kStanding), keys_down(0)}).isovalue);
}

TEST(Navigator, TheWheelKeepsThePlaceUnderTheCursor) {
    Desk desk;
    const Pose ray{
        kStanding.position,
        glm::quatLookAt(glm::normalize(glm::vec3(0.2f, -0.3f, -1.0f)), glm::vec3(0, 1, 0))};
    const double depth = kStanding.position.z - desk.center().z;
    const glm::dvec3 there = glm::dvec3(kStanding.position) + depth * glm::dvec3(0.2, -0.3, -1.0);
    const glm::dvec3 before = physical(desk.volume(), there);
    for (const float notches : {3.0f, -5.0f, 2.0f}) {
        const double scale = desk.volume().scale;
        desk.wheel(notches, ray);
        EXPECT_NEAR(desk.volume().scale / scale, std::pow(1.1, notches), 1e-6);
        expect_near(physical(desk.volume(), there), before, 1e-3);
    }
    Desk without;
    const glm::dvec3 center = without.center();
    without.wheel(4.0f);
    expect_near(without.center(), center, 1e-9);
}

TEST(Navigator, TheWheelStopsAtItsBoundsAndSaysSo) {
    for (const float way : {20.0f, -20.0f}) {
        Desk desk;
        const double home = desk.context.series.home.scale;
        for (int i = 0; i < 20; ++i)
            desk.wheel(way);
        EXPECT_NEAR(desk.volume().scale, way > 0 ? home * 100 : home / 20, 1e-9 * home * 100);
        EXPECT_THAT(desk.notes(), testing::Contains("the data can be made no larger or smaller; "
                                                    "Home resets the view and all settings"));
        desk.tap(bit(Action::reset));
        EXPECT_EQ(desk.volume(), desk.context.series.home);
    }
}

TEST(Navigator, AxisViewsShowEachAxisTowardsTheEyeInTheMiddle) {
    const Pose viewer{{0.4f, 1.5f, 0.2f}, glm::angleAxis(0.7f, glm::normalize(glm::vec3(1, 3, 0)))};
    const Similarity from{
        {0.3, 1.1, -1.7}, glm::angleAxis(1.1, glm::normalize(glm::dvec3(1, 2, 3))), 0.02};
    const glm::dvec3 center(30, 25, 30);
    const double away = glm::length(transform(from, center) - glm::dvec3(viewer.position));
    for (const AxisView& view : axis_views()) {
        const Similarity seen = seen_from(view, from, center, viewer);
        EXPECT_EQ(seen.scale, from.scale);
        const glm::dvec3 at = transform(seen, center);
        const glm::dquat eye(viewer.orientation);
        expect_near(at, glm::dvec3(viewer.position) + eye * glm::dvec3(0, 0, -away), 1e-6);
        const glm::dvec3 towards = seen.rotation * glm::normalize(view.towards_eye);
        expect_near(towards, eye * glm::dvec3(0, 0, 1), 1e-6);
        EXPECT_GT(glm::dot(seen.rotation * view.up, eye * glm::dvec3(0, 1, 0)), 0.5) << view.name;
    }
}

TEST(Controls, AKeyGoesThroughTheAxisViewsAndOneIsIsometric) {
    Desk desk;
    for (std::size_t i = 0; i < 2 * kIsometric; ++i) { // at first they are seen from +z
        desk.tap(bit(Action::axis_view));
        const Similarity expected = seen_from(axis_views()[(i + 5) % kIsometric], desk.volume(),
                                              desk.context.series.pivot, kStanding);
        EXPECT_LT(glm::length(desk.volume().rotation - expected.rotation), 1e-6) << i;
    }
    desk.tap(bit(Action::isometric_view));
    EXPECT_EQ(desk.volume(), seen_from(axis_views()[kIsometric], desk.volume(),
                                       desk.context.series.pivot, kStanding));
    EXPECT_EQ(desk.tap(bit(Action::orthographic)).orthographic, true);
    desk.settings.orthographic = true;
    EXPECT_EQ(desk.tap(bit(Action::room_panel)).orthographic, false)
        << "the panel in the room is read in perspective";
}

TEST(Controls, KeysExaggerateHeightsAboutTheCenterAndTakeThatBack) {
    Desk desk;
    const Similarity before = desk.volume();
    const glm::dvec3 center = transform(before, desk.context.series.pivot);
    desk.tap(bit(Action::exaggerate));
    desk.tap(bit(Action::exaggerate));
    EXPECT_DOUBLE_EQ(desk.volume().exaggeration, 1.5625);
    EXPECT_LT(glm::distance(transform(desk.volume(), desk.context.series.pivot), center), 1e-12);
    const glm::dvec3 up =
        transform(desk.volume(), desk.context.series.pivot + glm::dvec3(0, 0, 1)) - center;
    EXPECT_NEAR(glm::length(up), 1.5625 * before.scale, 1e-12);
    const glm::dvec3 at(3, -7, 11);
    EXPECT_LT(glm::distance(in_physical(desk.volume(), transform(desk.volume(), at)), at), 1e-9);
    EXPECT_LT(glm::distance(glm::dvec3(matrix(desk.volume()) * glm::dvec4(at, 1)),
                            transform(desk.volume(), at)),
              1e-12);
    for (int i = 0; i < 2; ++i)
        desk.tap(bit(Action::flatten));
    EXPECT_EQ(desk.volume().exaggeration, 1);
    for (int i = 0; i < 60; ++i)
        desk.tap(bit(Action::exaggerate));
    EXPECT_EQ(desk.volume().exaggeration, kMostExaggeration);
    desk.tap(bit(Action::reset));
    EXPECT_EQ(desk.volume(), desk.context.series.home);
}

TEST(Navigation, MovingTurningAndScalingKeepHeightsExaggerated) {
    Similarity volume{{1, 2, 3}, {1, 0, 0, 0}, 0.5, 4};
    const Pose pose{{0, 1, 0}, {1, 0, 0, 0}};
    const Span span{{0, 0, 0}, {1, 0, 0}};
    EXPECT_EQ(moved(volume, {1, 0, 0}).exaggeration, 4);
    EXPECT_EQ(turned(volume, {0, 0, 0}, {0, 1, 0}, 1).exaggeration, 4);
    EXPECT_EQ(scaled(volume, {0, 0, 0}, 2, 0.1, 10).exaggeration, 4);
    EXPECT_EQ(carried(volume, pose, pose).exaggeration, 4);
    EXPECT_EQ(stretched(volume, span, span, {1, 0, 0, 0}, 0.1, 10).exaggeration, 4);
    // A plane's normal stays at right angles to it.
    const glm::dvec3 normal = glm::normalize(glm::dvec3(1, 2, 3)), in_plane(2, -1, 0);
    const glm::dvec3 steep = glm::cross(normal, in_plane);
    const glm::dvec3 shown = normal_in_room(volume, normal);
    for (const glm::dvec3& v : {in_plane, steep})
        EXPECT_NEAR(glm::dot(shown, transform(volume, v) - transform(volume, {0, 0, 0})), 0, 1e-12);
    EXPECT_LT(glm::distance(normal_in_physical(volume, shown), normal), 1e-12);
}

TEST(Controls, PageKeysMoveTheIsovalueByTheSameStepsAsArrows) {
    Desk desk;
    desk.tap(bit(Action::isovalue_rise));
    EXPECT_DOUBLE_EQ(desk.settings.isovalue(), 51);
    desk.tap(bit(Action::isovalue_fall) | bit(Action::shift));
    EXPECT_DOUBLE_EQ(desk.settings.isovalue(), 50.9);
    // Recordings of before moved the wand's valuator, which counts once.
    Desk old;
    DeviceState wand = wand_at(kStanding);
    wand.valuators = {1.0f};
    old.frame({head_at(kStanding), keys_down(0)});
    old.frame({head_at(kStanding), wand, keys_down(bit(Action::isovalue_rise))}, 0.04);
    EXPECT_NEAR(old.settings.isovalue(), 51, 1e-9) << "a quarter of the range in a second";
}

TEST(Controls, NothingEverMakesTheVolumeInvalid) {
    const float inf = std::numeric_limits<float>::infinity();
    const float odd[] = {std::nanf(""), inf, -inf, 1e38f, -1e38f, 0.0f, 1e-45f, 0.5f};
    Random random(test_seed());
    for (int round = 0; round < tries(300); ++round) {
        SCOPED_TRACE(testing::Message() << "round " << round);
        const auto any = [&] { return odd[random() % std::size(odd)]; };
        Desk desk;
        for (int frame = 0; frame < 100; ++frame) {
            const Pose wild{{any(), any(), any()}, glm::quat(any(), any(), any(), any())};
            std::vector<float> mouse(kMouseValuators);
            for (float& value : mouse)
                value = any();
            desk.frame({head_at(random() % 2 ? wild : kStanding),
                        wand_at(random() % 2 ? wild : kStanding, random(), any(), any()),
                        mouse_dragged(mouse),
                        keys_down(random()),
                        {"gamepad", std::nullopt, true, random(), {any(), any(), any(), any()}}},
                       uniform(random, 0, 1));
            ASSERT_TRUE(is_valid(desk.volume()));
            ASSERT_NEAR(glm::length(desk.volume().rotation), 1.0, 1e-9);
            ASSERT_GE(desk.settings.isovalue(), 0);
            ASSERT_LE(desk.settings.isovalue(), 100);
            ASSERT_LT(desk.settings.instant, Instant(5));
        }
    }
}

} // namespace
} // namespace isochron::interaction
