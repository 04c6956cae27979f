// Devices change isovalue, time and switches; commands merge.
#include "tests/interaction/controls/control_desk.h"

#include <cmath>
#include <limits>
#include <set>

namespace isochron::interaction {
namespace {

TEST(Controls, KeysStepTheIsovalueByOnePercentOrAThousandth) {
    Desk desk;
    desk.tap(bit(Action::isovalue_up));
    EXPECT_NEAR(desk.settings.isovalue(), 51, 1e-9);
    desk.tap(bit(Action::isovalue_down) | bit(Action::shift));
    EXPECT_NEAR(desk.settings.isovalue(), 50.9, 1e-9);
    std::vector<float> wheel(kMouseValuators, 0.0f);
    wheel[kMouseWheel] = 2;
    desk.frame({keys_down(bit(Action::control)), mouse_dragged(wheel)});
    EXPECT_NEAR(desk.settings.isovalue(), 51.1, 1e-9);
    EXPECT_EQ(desk.volume(), desk.context.series.home);
}

TEST(Controls, AHeldKeyRepeatsAfterADelayAtAnyFrameRate) {
    for (const int rate : {20, 60, 144}) {
        Desk desk;
        for (int frame = 0; frame < 2 * rate; ++frame)
            desk.frame({keys_down(bit(Action::isovalue_up))}, 1.0 / rate);
        EXPECT_NEAR(desk.settings.isovalue(), 50 + 1 + 1.6 / 0.05, 2) << rate;
    }
}

TEST(Controls, TheWandValuatorRunsThroughTheRangeInFourSeconds) {
    for (const int rate : {20, 60, 144}) {
        Desk desk;
        desk.settings.set_isovalue(0);
        desk.frame({});
        for (int frame = 0; frame < 2 * rate; ++frame)
            desk.frame({wand_at(kStanding, 0, 1)}, 1.0 / rate);
        EXPECT_NEAR(desk.settings.isovalue(), 50, 1e-6);
        for (int frame = 0; frame < 3 * rate; ++frame)
            desk.frame({wand_at(kStanding, 0, 1)}, 1.0 / rate);
        EXPECT_EQ(desk.settings.isovalue(), 100);
        EXPECT_TRUE(desk.frame({wand_at(kStanding, 0, 1)}).empty());
    }
}

TEST(Controls, GamepadTriggersChangeTheIsovalueAndSticksFly) {
    Desk desk;
    desk.frame({});
    desk.frame({{"gamepad", std::nullopt, true, 0, {0, 0, 0, 0, 0, 1}}}, 0.1);
    EXPECT_NEAR(desk.settings.isovalue(), 52.5, 1e-9);
    desk.frame({{"gamepad", std::nullopt, true, 0, {0, 0, 0, 0, 1, 0}}}, 0.1);
    EXPECT_NEAR(desk.settings.isovalue(), 50, 1e-9);
    const glm::dvec3 before = desk.center();
    desk.frame({head_at(kStanding), {"gamepad", std::nullopt, true, 0, {0, -1, 0, 0, 0, 0}}}, 0.1);
    expect_near(desk.center() - before, {0, 0, 0.1}, 1e-7); // ahead: it comes nearer
    desk.frame({head_at(kStanding), {"gamepad", std::nullopt, true, 0, {0, 0, 1, 0, 0, 0}}}, 0.1);
    EXPECT_LT(desk.center().x, before.x); // turning right: it swings to the left
    desk.frame({{"gamepad", std::nullopt, true, bit(GamepadButton::right_bumper), {}}});
    EXPECT_EQ(desk.settings.instant, Instant(1));
    desk.frame({{"gamepad", std::nullopt, true, bit(GamepadButton::a), {}}});
    EXPECT_TRUE(desk.settings.playback.playing);
}

TEST(Controls, SteppingWrapsWithLoopStopsWithoutAndPauses) {
    Desk desk;
    desk.tap(bit(Action::step_back));
    EXPECT_EQ(desk.settings.instant, Instant(4));
    desk.tap(bit(Action::step_forward));
    EXPECT_EQ(desk.settings.instant, Instant(0));
    desk.tap(bit(Action::loop));
    EXPECT_FALSE(desk.settings.playback.loop);
    desk.tap(bit(Action::step_back));
    EXPECT_EQ(desk.settings.instant, Instant(0));
    desk.tap(bit(Action::play));
    EXPECT_TRUE(desk.settings.playback.playing);
    desk.tap(bit(Action::step_forward));
    EXPECT_FALSE(desk.settings.playback.playing);
    EXPECT_EQ(desk.settings.instant, Instant(1));
}

TEST(Controls, PlayingRunsThroughTheSeriesInTenSeconds) {
    Desk desk;
    desk.tap(bit(Action::play));
    std::vector<int> frames(5, 0);
    for (int frame = 0; frame < 600; ++frame) {
        desk.frame({head_at(kStanding)});
        ++frames[desk.settings.instant.step];
    }
    for (const int count : frames)
        EXPECT_NEAR(count, 120, 3);
}

TEST(Controls, PlaybackKeysReverseAndChangeSpeedWithinBounds) {
    Desk desk;
    desk.tap(bit(Action::reverse));
    EXPECT_TRUE(desk.settings.playback.reverse);
    desk.tap(bit(Action::faster));
    EXPECT_EQ(desk.settings.playback.speed, 2.0);
    for (int i = 0; i < 20; ++i)
        desk.tap(bit(Action::faster));
    EXPECT_EQ(desk.settings.playback.speed, kFastest);
    for (int i = 0; i < 20; ++i)
        desk.tap(bit(Action::slower));
    EXPECT_EQ(desk.settings.playback.speed, kSlowest);
}

TEST(Controls, FollowingGoesToTheLastStep) {
    Desk desk;
    const Commands on = desk.tap(bit(Action::follow));
    EXPECT_EQ(on.follow, true);
    EXPECT_EQ(on.instant, Instant(4));
    desk.settings.follow = true;
    const Commands off = desk.tap(bit(Action::follow));
    EXPECT_EQ(off.follow, false);
    EXPECT_FALSE(off.instant);
}

TEST(Controls, OneStepDoesNotPlay) {
    Desk desk;
    desk.times = {7};
    EXPECT_TRUE(desk.tap(bit(Action::play)).empty());
    EXPECT_TRUE(desk.tap(bit(Action::step_forward)).empty());
    desk.settings.playback.playing = true; // the panel's doing
    desk.frame({});
    EXPECT_FALSE(desk.settings.playback.playing);
}

TEST(Controls, SwitchesReportOnlyChanges) {
    Desk desk;
    EXPECT_EQ(desk.tap(bit(Action::quality_best)).quality, QualityMode::quality);
    EXPECT_TRUE(desk.tap(bit(Action::quality_best)).empty());
    EXPECT_NEAR(*desk.tap(bit(Action::eyes_apart)).eye_separation, 0.064f, 1e-7f);
    for (int i = 0; i < 100; ++i)
        desk.tap(bit(Action::eyes_together));
    EXPECT_EQ(desk.settings.eye_separation, 0.0f);
    EXPECT_TRUE(desk.tap(bit(Action::eyes_together)).empty());
    EXPECT_EQ(desk.tap(bit(Action::next_stereo)).stereo, "side_by_side");
    desk.tap(bit(Action::next_stereo));
    EXPECT_EQ(desk.tap(bit(Action::next_stereo)).stereo, "mono");
    EXPECT_EQ(desk.tap(bit(Action::panel)).panel, false);
    EXPECT_TRUE(desk.tap(bit(Action::screenshot)).screenshot);
    EXPECT_EQ(desk.tap(bit(Action::stamp)).stamps, std::vector<std::string>{"stamp-1"});
    EXPECT_EQ(desk.tap(bit(Action::stamp)).stamps, std::vector<std::string>{"stamp-2"});
    EXPECT_TRUE(desk.tap(bit(Action::quit)).empty()) << "Escape never asks";
    EXPECT_EQ(desk.tap(bit(Action::ask_to_quit)).leaving, true);
    EXPECT_EQ(desk.tap(bit(Action::quit)).leaving, false) << "stays";
    EXPECT_FALSE(desk.tap(bit(Action::pick)).quit) << "nobody asks any more";
    desk.tap(bit(Action::ask_to_quit));
    EXPECT_TRUE(desk.tap(bit(Action::pick)).quit);
}

TEST(Controls, SayWhatKeysHaveDoneThatThePictureDoesNotShow) {
    Desk desk;
    desk.settings.isosurfaces.resize(2);
    const struct {
        Action action;
        const char* words;
    } rows[] = {{Action::next_stereo, "stereo: side_by_side"},
                {Action::quality_fast, "quality: fast"},
                {Action::next_surface, "surface 2 of 2"},
                {Action::orthographic, "parallel projection: on"},
                {Action::between_steps, "between steps: blend"},
                {Action::follow, "following the last step: on"},
                {Action::loop, "loop: off"},
                {Action::ping_pong, "back and forth: on"},
                {Action::reverse, "time runs back"},
                {Action::faster, "speed: x 2"},
                {Action::skip_more, "1 step in 2 is played"},
                {Action::range_first, "plays steps 5 to the last"},
                {Action::range_all, "plays all steps"},
                {Action::eyes_apart, "eyes 64 mm apart"},
                {Action::next_view, "no viewpoint is saved: B saves this one"},
                {Action::save_view, "viewpoint view-1 saved: N goes there"},
                {Action::next_view, "viewpoint view-1"},
                {Action::teleport, "no floor there: T teleports to a place on the floor"}};
    for (const auto& row : rows) {
        desk.notes();
        desk.tap(row.action);
        EXPECT_EQ(desk.notes(), std::vector<std::string>{row.words});
    }
}

TEST(Controls, KeysAndMouseOnlyAnswerWhileTheProgramAsksWhetherToQuit) {
    Desk desk;
    desk.tap(Action::ask_to_quit);
    for (const Action action : {Action::play, Action::step_forward, Action::orthographic,
                                Action::reset, Action::next_view, Action::isovalue_up})
        EXPECT_EQ(desk.tap(action), Commands()) << name_of(action);
    EXPECT_EQ(desk.wheel(3), Commands());
    EXPECT_EQ(desk.tap(Action::quit).leaving, false);
    EXPECT_TRUE(desk.tap(Action::orthographic).orthographic);
}

TEST(Controls, LooksGoRoundByKeys) {
    Desk desk;
    EXPECT_EQ(desk.tap(bit(Action::bounding_box)).bounding_box, false);
    EXPECT_EQ(desk.tap(bit(Action::bounding_box)).bounding_box, true);
    EXPECT_TRUE(desk.tap(bit(Action::next_surface)).empty()); // there is but one
    desk.settings.isosurfaces.resize(3);
    EXPECT_EQ(desk.tap(bit(Action::next_surface)).picked, 1u);
    EXPECT_EQ(desk.tap(bit(Action::next_surface)).picked, 2u);
    EXPECT_EQ(desk.tap(bit(Action::next_surface)).picked, 0u);
    desk.settings.coloring = {ColorBy::surface, "dusk", std::array{1.0, 2.0}};
    EXPECT_EQ(desk.tap(bit(Action::next_coloring)).coloring,
              (Coloring{ColorBy::first_crossing, "dusk", {}}));
    desk.tap(bit(Action::next_coloring));
    const std::vector<std::string> arrays{"u"};
    desk.context.color_arrays.names = &arrays;
    EXPECT_EQ(desk.tap(bit(Action::next_coloring)).coloring,
              (Coloring{ColorBy::value, "dusk", {}}));
}

TEST(Controls, EveryActionHasAKeyAndEveryKeyOneLineOfDocumentation) {
    std::set<Action> actions;
    std::set<std::pair<Key, Chord>> keys;
    for (const KeyBinding& binding : key_bindings()) {
        actions.insert(binding.action);
        EXPECT_TRUE(keys.insert({binding.key, binding.chord}).second) << name_of(binding.action);
    }
    EXPECT_EQ(actions.size(), kActions - 1) << "grabbing is a hand's first tool and needs no key";
    std::size_t lines = 0;
    std::set<DeviceKind> devices;
    for (const ControlGroup& group : Controls::documentation()) {
        EXPECT_TRUE(devices.insert(group.device).second);
        lines += group.lines.size();
        for (const std::string& line : group.lines) {
            EXPECT_LE(line.size(), 90u);
            EXPECT_EQ(line.find('\n'), std::string::npos);
            // The help takes them apart at the first two spaces, into control and effect.
            const std::size_t effect = line.find_first_not_of(' ', line.find("  "));
            ASSERT_NE(effect, std::string::npos) << line;
            EXPECT_NE(line.substr(effect), "the same") << line;
        }
    }
    EXPECT_EQ(lines, key_lines().size() + control_lines().size());
    EXPECT_EQ(devices.size(), 4u);
}

TEST(ActionTable, HasOneRowForEachActionWithANameAndAnOldBitOfItsOwn) {
    std::set<Action> actions;
    std::set<std::string> names;
    std::set<int> old_bits;
    for (const KeyLine& line : key_lines())
        for (const ActionRow& row : line.actions) {
            EXPECT_TRUE(actions.insert(row.action).second) << row.name;
            EXPECT_TRUE(names.insert(row.name).second) << row.name;
            EXPECT_TRUE(row.old_bit == kNoOldBit || old_bits.insert(row.old_bit).second);
            EXPECT_EQ(name_of(row.action), row.name);
            EXPECT_EQ(action_named(row.name), row.action);
        }
    EXPECT_EQ(actions.size(), kActions);
    EXPECT_EQ(old_bits.size(), 81u) << "version 1 of recordings had so many";
    EXPECT_EQ(*old_bits.rbegin(), 80);
}

TEST(Commands, MergingKeepsTheLaterAndCollectsStamps) {
    Commands a, b;
    a.isovalue = 1;
    a.instant = Instant(2);
    a.stamps = {"one"};
    a.screenshot = true;
    b.isovalue = 3;
    b.panel = false;
    b.stamps = {"two"};
    merge(a, b);
    EXPECT_EQ(a.isovalue, 3);
    EXPECT_EQ(a.instant, Instant(2));
    EXPECT_EQ(a.panel, false);
    EXPECT_TRUE(a.screenshot);
    EXPECT_EQ(a.stamps, (std::vector<std::string>{"one", "two"}));
    EXPECT_FALSE(a.empty());
    EXPECT_TRUE(Commands{}.empty());
}

} // namespace
} // namespace isochron::interaction
