// Surfaces and coloring: what commands set, what is refused, and old recordings.
#include "app/frame/explorer_state.h"

#include "interaction/navigation/key_frames.h"
#include "interaction/recording/commands_json.h"
#include "interaction/recording/recording.h"

#include <gtest/gtest.h>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::Isosurface;

std::vector<Isosurface> three() {
    return {{1, {1, 0, 0}, 1}, {2, {0, 1, 0}, 0.5f}, {3, {0, 0, 1}, 0.25f}};
}

TEST(ExplorerState, AnIsovalueMovesThePickedSurfaceAlone) {
    ExplorerState state;
    Commands commands;
    commands.isosurfaces = three();
    commands.picked = 1;
    commands.isovalue = 7;
    EXPECT_TRUE(state.apply(commands, 1));
    EXPECT_EQ(state.isovalue(), 7);
    EXPECT_EQ(state.isosurfaces[0].isovalue, 1);
    EXPECT_EQ(state.isosurfaces[2].isovalue, 3);
}

TEST(ExplorerState, FewerSurfacesLeaveOneThatExistsPicked) {
    ExplorerState state;
    Commands commands;
    commands.isosurfaces = three();
    commands.picked = 2;
    state.apply(commands, 1);
    Commands fewer;
    fewer.isosurfaces = std::vector<Isosurface>{{4, {1, 1, 1}, 1}};
    EXPECT_TRUE(state.apply(fewer, 1));
    EXPECT_EQ(state.picked, 0u);
    EXPECT_EQ(state.isovalue(), 4);
}

TEST(ExplorerState, RefusesWhatItCannotHold) {
    const auto refused = [](const Commands& commands) {
        ExplorerState state;
        const ExplorerState before = state;
        return !state.apply(commands, 1) && state == before;
    };
    Commands none, many, infinite, beyond, unknown;
    none.isosurfaces.emplace();
    many.isosurfaces = std::vector<Isosurface>(9);
    infinite.isosurfaces = std::vector<Isosurface>{{1.0 / 0.0, {}, 1}};
    beyond.picked = 1;
    unknown.coloring = {.map = "rainbow", .range = {}};
    for (const Commands& commands : {none, many, infinite, beyond, unknown})
        EXPECT_TRUE(refused(commands));
}

TEST(ExplorerState, RefusesTimesThatTheSeriesLacks) {
    constexpr std::size_t kHeld = 5;
    const auto refused = [](const auto& set) {
        ExplorerState state;
        const ExplorerState before = state;
        Commands commands;
        set(commands);
        return !state.apply(commands, kHeld) && state == before;
    };
    using interaction::StepRange;
    for (const StepRange& range : {StepRange{5, {}}, StepRange{{}, 5}, StepRange{3, 2}})
        EXPECT_TRUE(refused([&](Commands& commands) { commands.play_range = range; }));
    for (const StepRange& range : {StepRange{4, {}}, StepRange{2, 2}, StepRange{}})
        EXPECT_FALSE(refused([&](Commands& commands) { commands.play_range = range; }));
    EXPECT_TRUE(
        refused([](Commands& commands) { commands.bookmarks = {{"late", index::Instant(5)}}; }));
    EXPECT_FALSE(
        refused([](Commands& commands) { commands.bookmarks = {{"last", index::Instant(4)}}; }));
    using interaction::KeyFrame;
    const std::vector<std::pair<std::vector<KeyFrame>, bool>> kKeys{
        {{{.time = 0}, {.time = 1, .step = 4}}, false},
        {{{.time = 0}, {.time = 1, .step = 5}}, true},
        {{{.time = 0, .hold = 1}, {.time = 1}}, true},
        {{{.time = 1}, {.time = 0}}, true},
        {{{.time = interaction::kLongestFilm, .hold = 1}}, true},
        {{{.time = -1}}, true},
        {{{.time = 0, .isosurfaces = std::vector<interaction::Isosurface>()}}, true},
        {{{.time = 0, .clip = interaction::ClipPlane{true, {}, {0, 0, 2}}}}, true},
        {std::vector<KeyFrame>(interaction::kMostKeyFrames + 1), true}};
    for (const auto& [keys, wrong] : kKeys)
        EXPECT_EQ(refused([&](Commands& commands) { commands.keys = keys; }), wrong);
    for (const auto& playback :
         {interaction::PlaybackState{.every = 0}, interaction::PlaybackState{.every = 1001},
          interaction::PlaybackState{.rate = 0}})
        EXPECT_TRUE(refused([&](Commands& commands) { commands.playback = playback; }));
}

TEST(ExplorerState, AFractionAloneIsOfTheStepThatIsShown) {
    ExplorerState state;
    state.instant = {2, 5};
    Commands commands;
    commands.fraction = 77;
    EXPECT_TRUE(state.apply(commands, 5));
    EXPECT_EQ(state.instant, index::Instant(2, 77));
    commands.fraction = index::Instant::kFractions;
    EXPECT_FALSE(state.apply(commands, 5));
    EXPECT_EQ(state.instant, index::Instant(2, 77));
    EXPECT_EQ(state.refusals(commands, 5),
              std::vector<std::string>{"fraction is 65536, expected 0 to 65535"});
}

TEST(ExplorerState, WhatEarlierVersionsKeptIsDrawnWithoutOcclusion) {
    ExplorerState kept;
    kept.look = {interaction::Background::light, interaction::Material::metal, 0.25f};
    auto json = interaction::commands_json(kept.as_commands());
    ExplorerState state;
    EXPECT_TRUE(state.resume(interaction::commands_from(json, "start"), 1));
    EXPECT_EQ(state.look, kept.look);
    json.erase("look"); // which they did not have
    state = {};
    ASSERT_GT(state.look.occlusion, 0.0f);
    EXPECT_TRUE(state.resume(interaction::commands_from(json, "start"), 1));
    EXPECT_EQ(state.look, (interaction::Look{.occlusion = 0.0f}));
    // What a user wrote in place of a whole state changes what it names.
    Commands some;
    some.instant = index::Instant(0);
    state = {};
    EXPECT_TRUE(state.resume(some, 1));
    EXPECT_EQ(state.look, interaction::Look{});
}

TEST(ExplorerState, SetsAllOfItselfThroughJson) {
    ExplorerState state;
    state.isosurfaces = three();
    state.picked = 2;
    state.bounding_box = false;
    state.coloring = {interaction::ColorBy::value, "dusk", std::array{1.5, 2.5}};
    const auto json = interaction::commands_json(state.as_commands());
    ExplorerState again;
    EXPECT_TRUE(again.apply(interaction::commands_from(json, "start"), 1));
    EXPECT_EQ(again, state);
}

TEST(ExplorerState, IsKeptWithoutAnEmptyListOfKeysWhichEarlierVersionsDoNotKnow) {
    ExplorerState state;
    const Commands kept = interaction::kept_state(state.as_commands());
    EXPECT_FALSE(interaction::commands_json(kept).contains("keys"));
    state.keys.emplace_back();
    EXPECT_TRUE(
        interaction::commands_json(interaction::kept_state(state.as_commands())).contains("keys"));
    EXPECT_TRUE(state.resume(kept, 1)); // a whole state without keys has none
    EXPECT_TRUE(state.keys.empty());
}

TEST(ExplorerState, TakesAnOldStartStateWithOneIsovalueOnly) {
    ExplorerState state;
    const auto old = nlohmann::json::parse(R"({"isovalue":15.5,"panel":true,"step":0})");
    EXPECT_TRUE(state.apply(interaction::commands_from(old, "start"), 1));
    EXPECT_EQ(state.isosurfaces.size(), 1u);
    EXPECT_EQ(state.isovalue(), 15.5);
}

TEST(ExplorerState, ColorsByFirstCrossingsOfBlendsJustWhereStepsAreBlended) {
    ExplorerState state;
    state.coloring.by = interaction::ColorBy::first_crossing;
    EXPECT_EQ(state.surfaces().coloring, index::CellColoring::first_crossing);
    state.between = interaction::BetweenSteps::blend;
    EXPECT_EQ(state.surfaces().coloring, index::CellColoring::first_blended_crossing);
    state.quality = interaction::QualityMode::paper; // which holds
    EXPECT_EQ(state.surfaces().coloring, index::CellColoring::first_crossing);
}

TEST(ExplorerState, OfBrokenJsonIsAnErrorThatNamesTheField) {
    const auto error = [](const char* text) -> std::string {
        try {
            interaction::commands_from(nlohmann::json::parse(text), "commands");
        } catch (const interaction::Error& caught) {
            return caught.what();
        }
        return "";
    };
    EXPECT_NE(error(R"({"isosurfaces":[]})").find("isosurfaces"), std::string::npos);
    EXPECT_NE(
        error(R"({"isosurfaces":[{"isovalue":1,"color":[0,0,2],"opacity":1}]})").find("color"),
        std::string::npos);
    EXPECT_NE(error(R"({"coloring":{"by":"mood","map":"dusk"}})").find("first_crossing"),
              std::string::npos);
    EXPECT_NE(error(R"({"coloring":{"by":"value","map":"dusk","range":[2,1]}})").find("ascending"),
              std::string::npos);
}

TEST(Commands, ALaterListOfSurfacesBringsItsOwnIsovalue) {
    Commands first, later;
    first.isovalue = 5;
    later.isosurfaces = three();
    interaction::merge(first, later);
    EXPECT_FALSE(first.isovalue);
    EXPECT_EQ(first.isosurfaces, three());
}

} // namespace
} // namespace isochron::app
