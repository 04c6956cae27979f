// The devices that mouse and keyboard emulate.
#include "interaction/controls/desktop_emulation.h"

#include "tests/interaction/input_builders.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace isochron::interaction {
namespace {

/// Emulation with the default options, polled at a steady rate.
class EmulatedDesk {
  public:
    InputState poll(std::vector<WindowEvent> events = {}, double elapsed = 1.0 / 60) {
        emulation_.feed(events);
        now_ += elapsed;
        return emulation_.poll(Seconds(now_));
    }

  private:
    DesktopEmulation emulation_{EmulationOptions{}};
    double now_ = 0;
};

Pose pose_of(const InputState& input, const char* device) {
    return *input.find(device)->pose;
}

bool acts(const InputState& input, Action action) {
    return holds(input.find("keys")->actions, action);
}

glm::vec3 ray(const Pose& pose) {
    return pose.orientation * glm::vec3(0, 0, -1);
}

void expect_near(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-5f) {
    EXPECT_LT(glm::length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " against " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(DesktopEmulation, StartsWhereTheOptionsSay) {
    EmulationOptions options;
    options.head = {{1, 2, 3}, glm::angleAxis(0.5f, glm::vec3(0, 1, 0))};
    DesktopEmulation emulation(options);
    const InputState input = emulation.poll(Seconds(0));
    expect_near(pose_of(input, "head").position, {1, 2, 3});
    expect_near(ray(pose_of(input, "head")), ray(options.head));
    EXPECT_EQ(input.find("gamepad"), nullptr);
    EXPECT_EQ(input.find("mouse")->valuators.size(), kMouseValuators);
}

TEST(DesktopEmulation, WalkingCoversTheSameDistanceAtAnyFrameRate) {
    for (const double rate : {15.0, 30.0, 60.0, 144.0}) {
        EmulatedDesk desk;
        desk.poll({}, 0);
        InputState input = desk.poll({press(key_named('W'))}, 1 / rate);
        for (int frame = 1; frame < rate; ++frame)
            input = desk.poll({}, 1 / rate);
        expect_near(pose_of(input, "head").position, {0, 1.6f, -1}, 1e-4f);
    }
}

TEST(DesktopEmulation, ShiftWalksThreeTimesAsFast) {
    EmulatedDesk desk;
    desk.poll({}, 0);
    const InputState input = desk.poll({press(key_named('D')), press(Key::left_shift)}, 0.1);
    expect_near(pose_of(input, "head").position, {0.3f, 1.6f, 0});
}

TEST(DesktopEmulation, TheFirstPollAndAStallMoveLittle) {
    EmulatedDesk desk;
    expect_near(pose_of(desk.poll({press(key_named('E'))}, 5), "head").position, {0, 1.6f, 0});
    expect_near(pose_of(desk.poll({}, 60), "head").position, {0, 1.7f, 0});
}

TEST(DesktopEmulation, WalkingFollowsTheHeadingButStaysLevel) {
    EmulatedDesk desk;
    desk.poll({}, 0);
    desk.poll({cursor_at(0.5f, 0.5f), MouseButtonEvent{MouseButton::right, true},
               cursor_at(0.5f + 3.14159265f / 4 / 2, 0.3f),
               MouseButtonEvent{MouseButton::right, false}},
              0.01); // a quarter turn to the right, and up
    const InputState input = desk.poll({press(key_named('W'))}, 0.1);
    expect_near(pose_of(input, "head").position, {0.1f, 1.6f, 0}, 1e-4f);
    const glm::vec3 ahead = ray(pose_of(input, "head"));
    EXPECT_GT(ahead.y, 0.3f);
    EXPECT_NEAR((pose_of(input, "head").orientation * glm::vec3(1, 0, 0)).y, 0.0f, 1e-5f);
}

TEST(DesktopEmulation, LookingUpEndsShortOfTheZenith) {
    EmulatedDesk desk;
    desk.poll({cursor_at(0.5f, 0.9f), MouseButtonEvent{MouseButton::right, true}});
    for (int i = 0; i < 10; ++i) {
        desk.poll({cursor_at(0.5f, 0.1f)});
        desk.poll({MouseButtonEvent{MouseButton::right, false}, cursor_at(0.5f, 0.9f),
                   MouseButtonEvent{MouseButton::right, true}});
    }
    const glm::vec3 ahead = ray(pose_of(desk.poll(), "head"));
    EXPECT_GT(ahead.y, 0.99f);
    EXPECT_LT(ahead.z, 0.0f);
}

TEST(DesktopEmulation, HomeBringsTheHeadBack) {
    EmulatedDesk desk;
    const Pose start = pose_of(desk.poll(), "head");
    desk.poll({press(key_named('W'))});
    desk.poll({release(key_named('W'))});
    ASSERT_NE(pose_of(desk.poll(), "head"), start);
    EXPECT_EQ(pose_of(desk.poll({press(Key::home)}), "head"), start);
}

TEST(DesktopEmulation, DragsCountPerButtonInWindowHeights) {
    EmulatedDesk desk;
    desk.poll({cursor_at(0.2f, 0.2f)});
    const InputState input = desk.poll(
        {cursor_at(0.3f, 0.3f), MouseButtonEvent{MouseButton::left, true}, cursor_at(0.4f, 0.5f),
         MouseButtonEvent{MouseButton::left, false}, cursor_at(0.9f, 0.9f),
         MouseButtonEvent{MouseButton::middle, true}, cursor_at(0.8f, 0.9f), ScrollEvent{0, 1.5f}});
    const std::vector<float>& values = input.find("mouse")->valuators;
    EXPECT_NEAR(values[0], 0.2f, 1e-6f); // 0.1 of a window twice as wide as high
    EXPECT_NEAR(values[1], 0.2f, 1e-6f);
    EXPECT_EQ(values[2], 0.0f);
    EXPECT_NEAR(values[4], -0.2f, 1e-6f);
    EXPECT_EQ(values[kMouseWheel], 1.5f);
    EXPECT_EQ(input.find("mouse")->buttons, bit(MouseBit::left) | bit(MouseBit::middle));
    const InputState next = desk.poll();
    EXPECT_EQ(next.find("mouse")->valuators, std::vector<float>(kMouseValuators, 0.0f));
    EXPECT_EQ(next.find("mouse")->buttons, bit(MouseBit::middle));
}

TEST(DesktopEmulation, EveryTapIsOneEdgeHoweverSlowTheFrames) {
    for (unsigned seed = 0; seed < 50; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Random random(seed);
        EmulatedDesk desk;
        int taps = 0, edges = 0;
        bool shown = false;
        const auto see = [&](const InputState& input) {
            edges += acts(input, Action::play) && !shown;
            shown = acts(input, Action::play);
        };
        for (int frame = 0; frame < 10; ++frame) {
            std::vector<WindowEvent> events;
            for (unsigned i = random() % 3; i > 0; --i, ++taps) {
                events.push_back(press(Key::space));
                events.push_back(release(Key::space));
            }
            see(desk.poll(events));
        }
        for (int frame = 0; frame < 50; ++frame)
            see(desk.poll());
        EXPECT_EQ(edges, taps);
        EXPECT_FALSE(shown);
    }
}

TEST(DesktopEmulation, RepeatedPressesOfAHeldKeyAreOne) {
    EmulatedDesk desk;
    EXPECT_TRUE(
        acts(desk.poll({press(Key::up), press(Key::up), press(Key::up)}), Action::isovalue_up));
    for (int frame = 0; frame < 5; ++frame)
        EXPECT_TRUE(acts(desk.poll({press(Key::up)}), Action::isovalue_up));
    EXPECT_FALSE(acts(desk.poll({release(Key::up)}), Action::isovalue_up));
}

TEST(DesktopEmulation, TwoKeysOfOneActionHoldItTogether) {
    EmulatedDesk desk;
    EXPECT_TRUE(acts(desk.poll({press(Key::left_shift)}), Action::shift));
    desk.poll({press(Key::right_shift)});
    desk.poll({release(Key::left_shift)});
    EXPECT_TRUE(acts(desk.poll(), Action::shift));
    EXPECT_FALSE(acts(desk.poll({release(Key::right_shift)}), Action::shift));
}

TEST(DesktopEmulation, LosingTheFocusReleasesEverything) {
    EmulatedDesk desk;
    desk.poll({press(key_named('W')), press(key_named('G')),
               MouseButtonEvent{MouseButton::left, true}, cursor_at(0.5f, 0.5f)});
    desk.poll({FocusEvent{false}});
    const InputState input = desk.poll();
    EXPECT_TRUE(input.find("keys")->actions.none());
    EXPECT_EQ(input.find("mouse")->buttons, 0u);
    EXPECT_EQ(input.find("wand")->buttons, 0u);
    EXPECT_EQ(pose_of(desk.poll(), "head"), pose_of(input, "head"));
}

TEST(DesktopEmulation, TheWandRestsAtTheRightAndItsRayMeetsTheCursors) {
    for (unsigned seed = 0; seed < 50; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Random random(seed);
        EmulationOptions options;
        options.head = {{0.5f, 1.7f, 1.0f},
                        glm::angleAxis(float(uniform(random, -3, 3)), glm::vec3(0, 1, 0))};
        DesktopEmulation emulation(options);
        const auto x = float(uniform(random, 0, 1)), y = float(uniform(random, 0, 1));
        emulation.feed(std::vector<WindowEvent>{cursor_at(x, y)});
        const InputState input = emulation.poll(Seconds(0));
        const Pose head = pose_of(input, "head"), wand = pose_of(input, "wand");
        const glm::vec3 local = glm::conjugate(head.orientation) * (wand.position - head.position);
        EXPECT_GT(local.x, 0);
        EXPECT_LT(local.y, 0);
        EXPECT_NEAR(local.z, -options.wand_reach, 1e-5f);
        const float half = std::tan(options.vertical_fov / 2);
        const glm::vec3 through =
            head.orientation *
            glm::normalize(glm::vec3((2 * x - 1) * half * 2, (1 - 2 * y) * half, -1));
        const glm::vec3 target = head.position + 1.5f * through;
        expect_near(ray(wand), glm::normalize(target - wand.position), 1e-4f);
        EXPECT_NEAR(glm::length(wand.orientation), 1.0f, 1e-5f);
    }
}

TEST(DesktopEmulation, WandButtonsAndValuatorsHaveKeys) {
    EmulatedDesk desk;
    const InputState input = desk.poll(
        {press(key_named('G')), press(key_named('F')), press(Key::page_up), press(key_named('Z'))});
    const DeviceState& wand = *input.find("wand");
    EXPECT_EQ(wand.buttons, bit(WandButton::grab) | bit(WandButton::fly));
    EXPECT_EQ(wand.valuators, (std::vector<float>{0.0f, -1.0f}));
}

TEST(DesktopEmulation, AGamepadAppearsWithADeadZoneAndGoesAgain) {
    EmulatedDesk desk;
    const InputState input =
        desk.poll({GamepadEvent{true, {0.1f, -0.14f, 1.0f, -0.575f, -1.0f, 1.0f}, 5}});
    ASSERT_NE(input.find("gamepad"), nullptr);
    const std::vector<float>& axes = input.find("gamepad")->valuators;
    ASSERT_EQ(axes.size(), 6u);
    EXPECT_EQ(axes[0], 0.0f);
    EXPECT_EQ(axes[1], 0.0f);
    EXPECT_FLOAT_EQ(axes[2], 1.0f);
    EXPECT_FLOAT_EQ(axes[3], -0.5f);
    EXPECT_EQ(axes[4], 0.0f);
    EXPECT_FLOAT_EQ(axes[5], 1.0f);
    EXPECT_EQ(input.find("gamepad")->buttons, 5u);
    EXPECT_EQ(desk.poll({GamepadEvent{false, {}, 0}}).find("gamepad"), nullptr);
}

TEST(DesktopEmulation, OverThePanelInTheRoomTheCursorIsTheWandsAndTheLeftButtonItsFirst) {
    const PanelSize size;
    const Pose head{{0.0f, 1.6f, 0.0f}, {1, 0, 0, 0}};
    const RoomPanel panel{true, ahead_of(head, 0.65f)};
    DesktopEmulation emulation{EmulationOptions{}};
    double now = 0;
    const auto poll = [&](std::vector<WindowEvent> events) {
        emulation.feed(events);
        return emulation.poll(Seconds(now += 0.02));
    };
    const auto buttons = [](const InputState& input) { return input.find("wand")->buttons; };
    const auto drags = [](const InputState& input) {
        return input.find("mouse")->valuators[0] != 0;
    };
    const WindowEvent down = MouseButtonEvent{MouseButton::left, true},
                      up = MouseButtonEvent{MouseButton::left, false};
    // Straight ahead, where the panel's plane is.
    const Pose ray = head;
    const PanelHit expected = *hit_of(ray, panel.pose, size);
    ASSERT_TRUE(expected.inside());
    emulation.set_panel(panel, size);
    InputState input = poll({cursor_at(0.5f, 0.5f)});
    const auto hit = hit_of(pose_of(input, "wand"), panel.pose, size);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->at.x, expected.at.x, 1e-4);
    EXPECT_NEAR(hit->at.y, expected.at.y, 1e-4);
    EXPECT_EQ(buttons(poll({down})), bit(WandButton::grab));
    input = poll({cursor_at(0.99f, 0.5f)});
    EXPECT_EQ(buttons(input), bit(WandButton::grab)) << "dragged beside it";
    EXPECT_EQ(input.find("mouse")->buttons, 0u);
    EXPECT_FALSE(drags(input));
    EXPECT_FALSE(hit_of(pose_of(input, "wand"), panel.pose, size)->inside());
    EXPECT_EQ(buttons(poll({up})), 0u);
    input = poll({down});
    EXPECT_EQ(buttons(input), 0u);
    EXPECT_EQ(input.find("mouse")->buttons, bit(MouseBit::left));
    EXPECT_TRUE(drags(poll({cursor_at(0.5f, 0.5f)}))) << "what began in the world stays there";
    EXPECT_EQ(buttons(poll({up, down, up})), bit(WandButton::grab)) << "a click between two polls";
    emulation.set_panel({}, size);
    EXPECT_EQ(buttons(poll({down})), 0u);
}

/// Such a panel is far to the side and near, and stays where it is when the head comes closer.
TEST(DesktopEmulation, TheWandReachesAllOfAPanelThatStandsBesideTheData) {
    const PanelSize size;
    const RoomPanel panel{true, {{-0.62f, 1.6f, -0.5f}, {1, 0, 0, 0}}};
    DesktopEmulation emulation{EmulationOptions{}};
    emulation.set_panel(panel, size);
    emulation.set_eye([&](const Pose& head, const MouseMoveEvent& cursor) {
        const glm::vec3 way = place_on(panel.pose, size, {cursor.x, cursor.y}) - head.position;
        return Pose{head.position, glm::quatLookAt(glm::normalize(way), glm::vec3(0, 1, 0))};
    });
    double now = 0;
    for (const float closer : {0.0f, 0.3f})
        for (const float x : {0.01f, 0.5f, 0.99f})
            for (const float y : {0.01f, 0.5f, 0.99f}) {
                emulation.stand({{0.0f, 1.6f, -closer}, 0, 0});
                emulation.feed(std::vector<WindowEvent>{cursor_at(x, y)});
                const InputState input = emulation.poll(Seconds(now += 0.02));
                const auto hit = hit_of(pose_of(input, "wand"), panel.pose, size);
                ASSERT_TRUE(hit) << x << ", " << y << ", " << closer << " m closer";
                EXPECT_NEAR(hit->at.x, x, 2e-3);
                EXPECT_NEAR(hit->at.y, y, 2e-3);
            }
}

using Actions = std::set<Action>;
Actions actions_in(const InputState& input) {
    Actions all;
    for (std::size_t i = 0; i < kActions; ++i)
        all.insert(static_cast<Action>(i));
    std::erase_if(all, [&](Action action) { return !acts(input, action); });
    return all;
}

/// What a desk shows after a key was pressed with these modifiers, as the window states them.
Actions pressed_with(Key key, std::uint8_t modifiers) {
    EmulatedDesk desk;
    desk.poll();
    return actions_in(desk.poll({KeyEvent{key, true, modifiers}}));
}

TEST(DesktopEmulation, AKeyWithCtrlDoesOnlyWhatItIsBoundWith) {
    for (const KeyBinding& binding : key_bindings()) {
        const auto is_bound = [&](Chord chord) {
            for (const KeyBinding& each : key_bindings())
                if (each.key == binding.key && each.chord == chord)
                    return Actions{each.action};
            return Actions{};
        };
        const auto with = [](Actions all, const Actions& held) {
            return all.insert(held.begin(), held.end()), all;
        };
        const std::string name = std::to_string(static_cast<int>(binding.key));
        const Actions alone = pressed_with(binding.key, 0);
        EXPECT_EQ(with(alone, is_bound(Chord::none)), alone) << name;
        if (binding.action == Action::shift || binding.action == Action::control)
            continue;
        EXPECT_EQ(pressed_with(binding.key, static_cast<std::uint8_t>(Modifier::control)),
                  is_bound(Chord::control))
            << name;
        for (const Modifier modifier : {Modifier::alt, Modifier::super})
            for (const unsigned control : {0u, static_cast<unsigned>(Modifier::control)})
                EXPECT_EQ(pressed_with(binding.key, static_cast<std::uint8_t>(
                                                        static_cast<unsigned>(modifier) | control)),
                          Actions{})
                    << name;
        for (const Key held : {Key::left_control, Key::right_control}) {
            EmulatedDesk desk;
            desk.poll({press(held)});
            EXPECT_EQ(actions_in(desk.poll({press(binding.key)})),
                      with(is_bound(Chord::control), {Action::control}))
                << name;
            EmulatedDesk both;
            both.poll({press(Key::left_shift), press(held)});
            EXPECT_EQ(actions_in(both.poll({press(binding.key)})),
                      with(is_bound(Chord::control_shift), {Action::control, Action::shift}))
                << name;
        }
    }
}

TEST(DesktopEmulation, CtrlAndShiftCountWhicheverGoesDownFirst) {
    for (const bool shift_first : {true, false}) {
        EmulatedDesk desk;
        const Key first = shift_first ? Key::left_shift : Key::left_control;
        const Key second = shift_first ? Key::left_control : Key::left_shift;
        desk.poll({press(first)});
        const InputState input = desk.poll({press(second)});
        EXPECT_TRUE(acts(input, Action::shift) && acts(input, Action::control));
    }
}

TEST(DesktopEmulation, AKeyThatIsHeldGoesOnWhenCtrlFollows) {
    EmulatedDesk desk;
    desk.poll({press(key_named('G')), press(key_named('W'))});
    InputState input = desk.poll({press(Key::left_control)});
    input = desk.poll();
    EXPECT_TRUE(acts(input, Action::grab) && acts(input, Action::walk_forward));
    input = desk.poll({KeyEvent{key_named('W'), false, 1}, KeyEvent{key_named('G'), false, 1}});
    EXPECT_FALSE(acts(input, Action::grab) || acts(input, Action::walk_forward));
}

TEST(DesktopEmulation, AskingTwiceAtOneTimeMovesOnce) {
    DesktopEmulation emulation{EmulationOptions{}};
    emulation.poll(Seconds(0));
    emulation.feed(std::vector<WindowEvent>{press(key_named('W'))});
    const InputState once = emulation.poll(Seconds(0.05));
    EXPECT_EQ(emulation.poll(Seconds(0.05)), once);
}

} // namespace
} // namespace isochron::interaction
