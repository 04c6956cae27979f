// A story is told step by step by every device, with a motion that ends at the step's view or by a leap
// in the dark, and its files keep what it says.
#include "tests/interaction/controls/control_desk.h"

#include "interaction/controls/story_controls.h"
#include "interaction/error.h"
#include "interaction/navigation/comfort.h"
#include "interaction/navigation/key_frames.h"
#include "interaction/navigation/story.h"
#include "interaction/recording/commands_json.h"
#include "interaction/recording/key_film.h"
#include "tests/support/test_seed.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <string>

namespace isochron::interaction {
namespace {

/// Keys 1, 3 and 4 of four have texts.
class StoryDesk : public Desk {
  public:
    StoryDesk() {
        for (int i = 0; i < 4; ++i) {
            KeyFrame key;
            key.time = 2.0 * i;
            key.step = static_cast<std::uint32_t>(i);
            key.isovalue = 10.0 * (i + 1);
            key.room_from_physical = settings.room_from_physical;
            key.room_from_physical->translation += glm::dvec3(0.5 * (i + 1), 0, -0.2 * i);
            key.text = i == 1 ? "" : "what is seen";
            settings.keys.push_back(key);
        }
        settings.keys[2].name = "front arrives";
        idle(2);
    }
    std::vector<DeviceState> at_rest() { return {head_at(kStanding), keys_down(0)}; }
    Commands idle(int frames) {
        Commands all;
        for (int i = 0; i < frames; ++i)
            merge(all, frame(at_rest()));
        return all;
    }
    bool sees(std::size_t key) {
        return way_to_key(settings.keys[key], settings, kStanding).empty();
    }
};

struct Way {
    const char* name;
    std::function<std::vector<DeviceState>(bool onwards)> devices;
    bool begins; ///< also while no story is told
};

std::vector<Way> ways() {
    const auto buttons = [](const char* name, std::uint64_t bits) {
        return std::vector<DeviceState>{head_at(kStanding), {name, Pose{}, true, bits, {}}};
    };
    return {{"keys",
             [](bool onwards) {
                 return std::vector<DeviceState>{
                     head_at(kStanding),
                     keys_down(bit(onwards ? Action::next_told : Action::previous_told))};
             },
             true},
            {"wand's buttons",
             [=](bool onwards) {
                 return buttons("wand",
                                bit(onwards ? WandButton::next_time : WandButton::previous_time));
             },
             false},
            {"gamepad",
             [=](bool onwards) {
                 return buttons("gamepad",
                                bit(onwards ? GamepadButton::right : GamepadButton::left));
             },
             false},
            {"stick",
             [](bool onwards) {
                 std::vector<float> valuators(static_cast<std::size_t>(WandValuator::count), 0.0f);
                 valuators[static_cast<std::size_t>(WandValuator::step)] = onwards ? 1.0f : -1.0f;
                 return std::vector<DeviceState>{head_at(kStanding),
                                                 {"wand", Pose{}, true, 0, valuators}};
             },
             false}};
}

TEST(Story, EveryDeviceGoesThroughItsStepsAndAKeyLeavesIt) {
    for (const Way& way : ways()) {
        StoryDesk desk;
        const auto push = [&](bool onwards) {
            desk.frame(way.devices(onwards));
            desk.idle(100);
            return desk.settings.story;
        };
        EXPECT_EQ(push(true), way.begins ? 1u : 0u) << way.name;
        desk.settings.story = 1;
        desk.idle(100);
        EXPECT_TRUE(desk.sees(0)) << way.name;
        desk.notes();
        EXPECT_EQ(push(true), 3u) << way.name << ": the key without a text is no step";
        EXPECT_TRUE(desk.sees(2)) << way.name;
        EXPECT_EQ(desk.settings.instant, Instant(2)) << way.name;
        EXPECT_EQ(push(true), 4u) << way.name;
        EXPECT_EQ(push(true), 4u) << way.name;
        EXPECT_THAT(desk.notes(), testing::Contains("this is the last step of the story"))
            << way.name;
        EXPECT_EQ(push(false), 3u) << way.name;
        EXPECT_EQ(push(false), 1u) << way.name;
        EXPECT_EQ(push(false), 1u) << way.name;
        EXPECT_THAT(desk.notes(), testing::Contains("this is the first step of the story"))
            << way.name;
        EXPECT_EQ(desk.settings.instant, Instant(0))
            << way.name << ": what else moves time is the story's now";
    }
    for (const Action leaves : {Action::leave_story, Action::quit}) {
        StoryDesk desk;
        desk.settings.story = 3;
        desk.idle(100);
        desk.tap(leaves);
        EXPECT_EQ(desk.settings.story, 0u);
        EXPECT_TRUE(desk.sees(2)) << "the view stays";
    }
    StoryDesk desk;
    desk.settings.keys.clear();
    EXPECT_TRUE(desk.tap(Action::next_told).empty());
    EXPECT_THAT(desk.notes(), testing::ElementsAre(testing::HasSubstr("there is no story")));
}

TEST(Story, TheViewMovesToAStepWithoutAJumpAndEndsThereToTheBit) {
    StoryDesk desk;
    const glm::dvec3 from = desk.volume().translation,
                     to = desk.settings.keys[2].room_from_physical->translation;
    desk.settings.story = 3; // by a panel, a search or a program
    double passed = 0, last = 0, longest = 0;
    for (int i = 0; i < 72; ++i) {
        const Commands commands = desk.frame(desk.at_rest());
        EXPECT_EQ(commands.story, 3u) << "says whose change it is";
        EXPECT_EQ(desk.settings.isovalue(), 30) << "what else the step shows is there at once";
        const double share =
            glm::distance(desk.volume().translation, from) / glm::distance(to, from);
        EXPECT_GE(share, passed - 1e-12) << "never back";
        longest = std::max(longest, share - passed);
        passed = share;
        last = share - last;
    }
    EXPECT_LT(passed, 1);
    desk.idle(2);
    EXPECT_EQ(desk.volume(), *desk.settings.keys[2].room_from_physical);
    // The speed of a cubic that begins and ends at rest is 1.5 times the mean one at most.
    EXPECT_LE(longest, 1.5 / 72 * 1.01);
    EXPECT_TRUE(desk.idle(5).empty());
}

TEST(Story, WhoFliesNotBringsTheStepInTheDark) {
    StoryDesk desk;
    desk.context.fades = true;
    Comfort comfort({});
    const Similarity before = desk.volume();
    desk.settings.story = 4;
    double fade = 0, darkest_of_move = -1;
    for (int i = 0; i < 60; ++i) {
        const Similarity at = desk.volume();
        desk.frame(desk.at_rest());
        fade = comfort
                   .update({Seconds(i / 60.0), desk.at_rest()}, desk.volume(),
                           i == 0 ? 1 : desk.settings.story)
                   .fade;
        if (!(desk.volume() == at)) {
            EXPECT_EQ(darkest_of_move, -1) << "it leaps once";
            darkest_of_move = fade;
            EXPECT_EQ(at, before);
            EXPECT_TRUE(desk.sees(3));
        }
    }
    EXPECT_GT(darkest_of_move, 0.99);
    EXPECT_EQ(fade, 0) << "and there is light again";
}

TEST(Story, WhoeverMovesTheDataHasTheView) {
    for (const bool fades : {false, true}) {
        StoryDesk desk;
        desk.context.fades = fades;
        desk.settings.story = 3;
        desk.idle(5);
        desk.settings.room_from_physical.translation.y = 9; // undo, or a program
        const Commands commands = desk.idle(100);
        EXPECT_EQ(desk.volume().translation.y, 9);
        EXPECT_FALSE(commands.room_from_physical);
        EXPECT_EQ(desk.settings.story, 3u);
        EXPECT_EQ(desk.settings.isovalue(), 30) << "what else the step shows comes";
    }
}

TEST(Story, OfASessionThatGoesOnIsToldOnWithoutAMove) {
    Desk desk;
    desk.settings.keys.resize(2);
    desk.settings.keys[1].text = "here";
    desk.settings.keys[1].isovalue = 7;
    desk.settings.story = 2;
    EXPECT_TRUE(desk.frame({head_at(kStanding)}).empty()) << "the session has kept its view";
    ASSERT_NE(told_key(desk.settings), nullptr);
    EXPECT_EQ(told_key(desk.settings)->text, "here");
}

TEST(Story, StepsAreTheKeysWithTextsInTheirOrder) {
    Random random(test_seed());
    for (int round = 0; round < tries(200); ++round) {
        std::vector<KeyFrame> keys(random() % 7);
        std::vector<std::uint32_t> steps; // by hand
        for (std::uint32_t i = 0; i < keys.size(); ++i)
            if (random() % 2 == 0) {
                keys[i].text = "a";
                steps.push_back(i + 1);
            }
        for (std::uint32_t told = 0; told <= keys.size(); ++told) {
            const StoryStep step = story_step(keys, told);
            EXPECT_EQ(step.of, steps.size());
            const auto next = std::ranges::upper_bound(steps, told);
            const auto here = std::ranges::lower_bound(steps, told);
            EXPECT_EQ(step.next, next == steps.end() ? 0 : *next);
            EXPECT_EQ(step.previous, here == steps.begin() ? 0 : here[-1]);
            EXPECT_EQ(step.number, next - steps.begin());
        }
    }
}

TEST(Story, NamesAndTextsAreInFilesOnlyWhereTheyAre) {
    std::vector<KeyFrame> keys(2);
    keys[1].time = 1;
    EXPECT_EQ(keys_text(keys), R"({
  "format": "isochron keys",
  "keys": [
    {
      "fraction": 0,
      "hold": 0.0,
      "pace": "eased",
      "time": 0.0
    },
    {
      "fraction": 0,
      "hold": 0.0,
      "pace": "eased",
      "time": 1.0
    }
  ],
  "version": 1
}
)") << "byte for byte as before keys had names";
    keys[0].name = "front \"<b>arrives</b>\"";
    keys[1].text = std::string(kLongestStoryText, 'a');
    keys[1].place = {1, 2, 3};
    std::string data;
    EXPECT_EQ(keys_from(keys_text(keys, "run 42.isochron"), "a", &data), keys);
    EXPECT_EQ(data, "run 42.isochron");
    keys[1].text += 'a';
    EXPECT_THROW(keys_from(keys_text(keys), "a"), Error);
    keys[1].text.clear();
    keys[0].name = std::string(kLongestText + 1, 'a');
    EXPECT_THROW(keys_from(keys_text(keys), "a"), Error);
}

TEST(Story, TitlesOfAFilmStandWhileItRestsButLongEnoughToBeRead) {
    std::vector<KeyFrame> keys(3);
    keys[0].text = "first";
    keys[1].time = 1.5;
    keys[1].name = "second";
    keys[1].hold = 4;
    keys[2].time = 8;
    using Row = std::pair<double, std::uint32_t>;
    for (const auto& [time, told] :
         std::vector<Row>{{0, 1}, {1.4, 1}, {1.5, 2}, {5.5, 2}, {5.6, 0}, {7.9, 0}, {8, 0}, {9, 0}})
        EXPECT_EQ(titled_key(keys, time), told) << time;
    const auto frames =
        frames_of(keys, {.start = {}, .times = {{0, 1}}, .rate = 2, .titled = true});
    std::vector<std::uint32_t> told;
    std::uint32_t now = 0;
    for (const RecordedFrame& frame : frames)
        told.push_back(now = frame.commands.story.value_or(now));
    EXPECT_EQ(told,
              (std::vector<std::uint32_t>{1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 0, 0, 0, 0, 0}));
    for (const RecordedFrame& frame : frames_of(keys, {.start = {}, .times = {{0, 1}}, .rate = 2}))
        EXPECT_FALSE(frame.commands.story);
}

TEST(Story, AFilmAlongViewpointsGoesAtOneSpeed) {
    std::vector<Viewpoint> views(4);
    for (std::size_t i = 0; i < views.size(); ++i)
        views[i].room_from_physical = {{}, glm::dquat(1, 0, 0, 0), 1};
    views[1].room_from_physical.translation = {2, 0, 0};       // 2 m
    views[2].room_from_physical = views[1].room_from_physical; // none
    views[3].room_from_physical = views[2].room_from_physical;
    views[3].room_from_physical.scale = std::exp(1.0); // 1
    const auto keys = view_keys(views, {});
    ASSERT_EQ(keys.size(), 4u);
    EXPECT_NEAR(keys[1].time, 9 * 2.0 / 3, 1e-12);
    EXPECT_NEAR(keys[2].time - keys[1].time, 0.05, 1e-12);
    EXPECT_NEAR(keys[3].time - keys[2].time, 9 * 1.0 / 3, 1e-12);
    for (std::size_t i = 0; i < keys.size(); ++i)
        EXPECT_EQ(keys[i].room_from_physical, views[i].room_from_physical);
    EXPECT_EQ(keys_from(keys_text(keys), "a"), keys) << "in order";
    for (Viewpoint& view : views)
        view = views[0];
    EXPECT_EQ(keys_from(keys_text(view_keys(views, {})), "a").size(), 4u) << "all alike";
}

} // namespace
} // namespace isochron::interaction
