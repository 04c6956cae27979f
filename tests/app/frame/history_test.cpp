// Undo and redo: any change can be undone exactly, and a drag is one step.
#include "app/frame/history.h"
#include "interaction/input/actions.h"
#include "interaction/navigation/navigation.h"

#include "interaction/command_fields.h"
#include "interaction/navigation/key_frames.h"
#include "tests/interaction/recording/random_commands.h"
#include "tests/support/test_seed.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::InputState;
using interaction::Seconds;

constexpr std::size_t kSteps = 5;

/// A state that obeys, with its history.
class Explorer {
  public:
    void obey(const Commands& commands, double time, bool button = false) {
        InputState input{Seconds(time), {}};
        input.devices.push_back({"mouse", std::nullopt, true, button ? 1u : 0u, {}});
        const ExplorerState before = state;
        state.apply(commands, kSteps);
        history.add(before, state, commands, input);
    }
    bool undo(double time) {
        if (!history.undo())
            return false;
        obey(*history.undo(), time);
        return true;
    }
    bool redo(double time) {
        if (!history.redo())
            return false;
        obey(*history.redo(), time);
        return true;
    }
    ExplorerState state;
    History history;
};

/// The settings whose changes can be undone.
bool same_to_undo(const ExplorerState& a, const ExplorerState& b) {
    return a.commands_to(b) == Commands{};
}

/// A change of one setting to anything that it may be.
Commands one_change(interaction::Random& random) {
    const Commands all = interaction::random_commands(random);
    Commands one;
    std::size_t settings = 0;
    interaction::each_setting([&](const interaction::Field&, const auto&) { ++settings; }, all);
    std::size_t chosen = random() % settings;
    interaction::each_setting(
        [&](const interaction::Field&, const auto& from, auto& to) {
            if (chosen-- == 0)
                to = from;
        },
        all, one);
    return one;
}

TEST(History, KeyFramesAreUndoneAndRedone) {
    Explorer explorer;
    for (const int keys : {1, 2}) {
        Commands added;
        added.keys =
            interaction::with_key(explorer.state.keys, interaction::key_of(explorer.state, {}));
        explorer.obey(added, 10 * keys);
    }
    const auto both = explorer.state.keys;
    ASSERT_EQ(both.size(), 2u);
    EXPECT_TRUE(explorer.undo(30));
    EXPECT_EQ(explorer.state.keys.size(), 1u);
    EXPECT_TRUE(explorer.undo(40));
    EXPECT_TRUE(explorer.state.keys.empty());
    EXPECT_TRUE(explorer.redo(50));
    EXPECT_TRUE(explorer.redo(60));
    EXPECT_EQ(explorer.state.keys, both);
}

TEST(History, AnySingleChangeIsUndoneAndRedone) {
    interaction::Random random(test_seed());
    Explorer explorer;
    constexpr int kChanges = 10'000;
    int changed = 0, wrong = 0;
    double time = 0;
    for (int round = 0; changed < kChanges; ++round) {
        explorer.state.playback.playing = false; // what plays is tried below
        const ExplorerState before = explorer.state;
        explorer.obey(one_change(random), time += 10);
        const ExplorerState after = explorer.state;
        if (same_to_undo(before, after))
            continue;
        ++changed;
        ASSERT_TRUE(explorer.undo(time += 10));
        wrong += !same_to_undo(explorer.state, before);
        ASSERT_TRUE(explorer.redo(time += 10));
        wrong += !same_to_undo(explorer.state, after);
        if (round % 3 == 0)
            explorer.undo(time += 10);
    }
    std::printf("%d changes undone and done again: %d states differ\n", changed, wrong);
    EXPECT_EQ(wrong, 0);
}

TEST(History, ManyStepsComeBackInTheirOrder) {
    interaction::Random random(test_seed());
    Explorer explorer;
    std::vector<ExplorerState> states{explorer.state};
    double time = 0;
    while (states.size() < 100) {
        explorer.obey(one_change(random), time += 10);
        explorer.state.playback.playing = false;
        if (!same_to_undo(explorer.state, states.back()))
            states.push_back(explorer.state);
    }
    for (std::size_t i = states.size() - 1; i > 0; --i) {
        ASSERT_TRUE(explorer.undo(time += 10));
        EXPECT_TRUE(same_to_undo(explorer.state, states[i - 1])) << i;
    }
    EXPECT_FALSE(explorer.undo(time += 10));
    for (std::size_t i = 1; i < states.size(); ++i) {
        ASSERT_TRUE(explorer.redo(time += 10));
        EXPECT_TRUE(same_to_undo(explorer.state, states[i])) << i;
    }
    EXPECT_FALSE(explorer.redo(time += 10));
}

TEST(History, ADragIsOneStepHoweverLongItRests) {
    Explorer explorer;
    explorer.state.set_isovalue(1.0);
    for (int i = 0; i < 10; ++i) {
        Commands drag;
        drag.isovalue = 2.0 + i;
        explorer.obey(drag, i, true);
        explorer.obey({}, i + 0.5, true);
    }
    explorer.obey({}, 11);
    Commands another;
    another.isovalue = 20;
    explorer.obey(another, 11.1);
    ASSERT_TRUE(explorer.undo(12));
    EXPECT_EQ(explorer.state.isovalue(), 11.0) << "the button was let go between the two";
    ASSERT_TRUE(explorer.undo(13));
    EXPECT_EQ(explorer.state.isovalue(), 1.0);
    EXPECT_FALSE(explorer.history.undo());
}

TEST(History, SwitchesAreStepsOfTheirOwnHoweverFastTheyCome) {
    Explorer explorer;
    for (int i = 0; i < 4; ++i) {
        Commands toggle;
        toggle.grid = i % 2 == 0;
        explorer.obey(toggle, 0.01 * i);
    }
    ASSERT_TRUE(explorer.undo(1));
    EXPECT_TRUE(explorer.state.grid);
    ASSERT_TRUE(explorer.undo(2));
    EXPECT_FALSE(explorer.state.grid);
}

TEST(History, WhatPlaysIsNotUndoneStepByStep) {
    Explorer explorer;
    Commands play;
    play.playback = interaction::PlaybackState{.playing = true};
    explorer.obey(play, 0);
    for (std::uint32_t step = 1; step < kSteps; ++step) {
        Commands next;
        next.instant = index::Instant(step);
        explorer.obey(next, step);
    }
    ASSERT_TRUE(explorer.undo(10));
    EXPECT_FALSE(explorer.state.playback.playing);
    EXPECT_EQ(explorer.state.instant, index::Instant(0));
    EXPECT_FALSE(explorer.history.undo());
}

TEST(History, ThePanelAndTheQuestionWhetherToLeaveAreNoSteps) {
    Explorer explorer;
    Commands commands;
    commands.panel = false;
    commands.leaving = true;
    explorer.obey(commands, 0);
    EXPECT_FALSE(explorer.history.has_changes());
}

/// The key moves the emulated head, too: what undo brings back is what was seen.
TEST(History, UndoAfterHomeShowsWhatWasSeen) {
    History history;
    ExplorerState away, home;
    away.room_from_physical = {{0.4, 1.2, -2.0}, glm::dquat(glm::vec3(0.2f, 0.5f, 0.1f)), 0.3};
    home.room_from_physical = {{0.1, 1.3, -1.5}, glm::dquat(1, 0, 0, 0), 0.2};
    const auto frame = [](double time, const interaction::Pose& head,
                          const interaction::ActionSet& keys) {
        interaction::InputState input{interaction::Seconds(time), {}};
        input.devices.push_back({.name = "head", .pose = head, .valuators = {}});
        input.devices.push_back({.name = "keys", .pose = {}, .valuators = {}, .actions = keys});
        input.devices.push_back({.name = "pointer", .pose = head, .valuators = {}});
        return input;
    };
    const interaction::Pose there{{1.5f, 1.8f, 2.0f}, glm::angleAxis(0.9f, glm::vec3(0, 1, 0))};
    const interaction::Pose start{{0, 1.6f, 0}, {1, 0, 0, 0}};
    history.add(away, away, {}, frame(0, there, 0));
    history.add(away, home, {}, frame(1, start, bit(interaction::Action::reset)));
    ASSERT_TRUE(history.undo() && history.undo()->room_from_physical);
    const auto seen_by = [](const interaction::Pose& head, const interaction::Similarity& volume) {
        const glm::dvec3 in_room = interaction::transform(volume, {3, 2, 1});
        return glm::conjugate(glm::dquat(head.orientation)) * (in_room - glm::dvec3(head.position));
    };
    EXPECT_LT(glm::distance(seen_by(there, away.room_from_physical),
                            seen_by(start, *history.undo()->room_from_physical)),
              1e-5);
}

TEST(History, SaysInWordsWhatUndoAndRedoChange) {
    Explorer explorer;
    explorer.state.set_isovalue(9.4);
    const ExplorerState start = explorer.state;
    const auto said = [&](const Commands* way) {
        return words_for_way(explorer.state, way, kSteps);
    };
    EXPECT_EQ(said(explorer.history.undo()), "");
    Commands lower;
    lower.isovalue = 7.2;
    explorer.obey(lower, 1);
    EXPECT_EQ(said(explorer.history.undo()), "isovalue 7.2 to 9.4");
    ASSERT_TRUE(explorer.undo(2));
    EXPECT_EQ(said(explorer.history.redo()), "isovalue 9.4 to 7.2");
    Commands two;
    two.orthographic = true;
    two.clip = interaction::ClipPlane{true, {1, 2, 3}, {0, 0, 1}};
    explorer.obey(two, 3);
    EXPECT_EQ(said(explorer.history.undo()), "clip plane, projection");
    Commands surface;
    surface.isosurfaces = start.isosurfaces;
    surface.isosurfaces->front().opacity = 0.5f;
    explorer.obey(surface, 4);
    EXPECT_EQ(said(explorer.history.undo()), "opacity 50 to 100 %");
    surface.isosurfaces->emplace_back();
    explorer.obey(surface, 5);
    EXPECT_EQ(said(explorer.history.undo()), "surface removed");
}

TEST(History, HasWordsForEveryChangeThatCanBeUndone) {
    interaction::Random random(test_seed());
    for (int round = 0; round < 300; ++round) {
        Explorer explorer;
        const ExplorerState start = explorer.state;
        explorer.obey(one_change(random), 1);
        EXPECT_EQ(words_for_change(start, explorer.state).empty(),
                  same_to_undo(start, explorer.state));
    }
}

// Whatever a step of a story shows stays, and the change before it is undone alone.
TEST(History, UndoesNoStepOfAStory) {
    Explorer explorer;
    Commands change, step, look;
    change.isosurfaces = {{.isovalue = 2, .opacity = 0.5f}};
    explorer.obey(change, 1);
    look.grid = true;
    explorer.obey(look, 3);
    step.keys.emplace(1);
    step.keys->front().text = "a";
    explorer.obey(step, 5); // the keys are a change of the user's
    step = {};
    step.story = 1;
    step.room_from_physical = interaction::Similarity{{1, 2, 3}, {1, 0, 0, 0}, 2};
    step.instant.emplace(3);
    explorer.obey(step, 7);
    const ExplorerState told = explorer.state;
    ASSERT_TRUE(explorer.undo(9));
    EXPECT_TRUE(explorer.state.keys.empty());
    ASSERT_TRUE(explorer.undo(10));
    EXPECT_FALSE(explorer.state.grid);
    EXPECT_EQ(explorer.state.isosurfaces, told.isosurfaces);
    ASSERT_TRUE(explorer.undo(11));
    EXPECT_NE(explorer.state.isosurfaces, told.isosurfaces);
    EXPECT_EQ(explorer.state.room_from_physical, told.room_from_physical);
    EXPECT_EQ(explorer.state.instant, index::Instant(3));
    EXPECT_FALSE(explorer.undo(12));
    while (explorer.redo(13)) {
    }
    EXPECT_TRUE(same_to_undo(explorer.state, told));
}

} // namespace
} // namespace isochron::app
