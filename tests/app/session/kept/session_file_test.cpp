// A resumed session is the same as the saved one, pixel by pixel.
#include "app/explore/kept_session.h"
#include "app/session/kept/session_claim.h"
#include "app/session/kept/session_file.h"
#include "app/session/kept/session_keeper.h"
#include "tests/interaction/recording/random_commands.h"
#include "tests/support/session_fixture.h"
#include "tests/support/test_seed.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdio>
#include <set>

namespace isochron::app {
namespace {

using interaction::Commands;

constexpr std::size_t kSteps = 6;

SavedSession kept_of(const ExplorerState& state) {
    return {"isochron test",
            "/data/sphere.isochron",
            "0123456789abcdef",
            state.as_commands(),
            {{0.1f, 1.6f, -0.3f}, 0.123456789f, -0.2f}};
}

ExplorerState back_from(const std::filesystem::path& path) {
    return state_of(read_session(path), ExplorerState(), "0123456789abcdef", kSteps, "kept");
}

TEST(SessionFile, AnyStateComesBackAsItWas) {
    TestFolder folder;
    const auto path = folder.path() / "a.isochron-session";
    interaction::Random random(test_seed());
    ExplorerState state;
    for (int round = 0; round < 300; ++round) {
        state.apply(interaction::random_commands(random), kSteps);
        state.leaving = false; // nobody is asked again
        state.exporting = {};  // and nothing is exported again
        save_session(path, kept_of(state));
        EXPECT_EQ(back_from(path), state);
        EXPECT_EQ(read_session(path).head, kept_of(state).head);
    }
}

TEST(SessionFile, WhatIsNoneIsRefusedInOneLine) {
    TestFolder folder;
    const auto complaint = [&](const std::string& text) {
        try {
            state_of(read_session(folder.write("a.isochron-session", text)), {}, "0123456789abcdef",
                     kSteps, "a");
        } catch (const interaction::Error& error) {
            EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
            return std::string(error.what());
        }
        return std::string("no error");
    };
    using testing::HasSubstr;
    EXPECT_THAT(complaint(""), HasSubstr("not a session"));
    EXPECT_THAT(complaint("{"), HasSubstr("not JSON"));
    EXPECT_THAT(complaint("{\"format\":\"x\"}"), HasSubstr("not a session"));
    save_session(folder.path() / "good", kept_of({}));
    std::string good = folder.read("good");
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        return text.replace(text.find(from), from.size(), to);
    };
    EXPECT_EQ(complaint(good), "no error");
    EXPECT_THAT(complaint(with("\"version\": 1", "\"version\": 2")), HasSubstr("version"));
    EXPECT_THAT(complaint(with("0123456789abcdef", "fedcba9876543210")), HasSubstr("other data"));
    EXPECT_THAT(complaint(with("\"step\": 0", "\"step\": 6")), HasSubstr("does not fit the data"));
    EXPECT_THAT(complaint(with("\"yaw\"", "\"jaw\"")), HasSubstr("yaw"));
    const auto left = [&](const std::string& arrays) {
        return complaint(with("{\n", "{\n\"arrays\": " + arrays + ",\n"));
    };
    EXPECT_EQ(left("[]"), "no error");
    EXPECT_THAT(left("[{\"array\": \"p\"}]"), HasSubstr("expected array, isosurfaces, picked"));
    EXPECT_THAT(left("{}"), HasSubstr("arrays"));
}

TEST(SessionKeeper, SavesWhatHasChangedAndKeepsWhatWasThere) {
    TestFolder folder;
    const auto path = folder.path() / "deep" / "a.isochron-session";
    ExplorerState state;
    SavedSession start = kept_of(state);
    const interaction::StandingPlace head = start.head;
    {
        SessionKeeper keeper(path, start, false);
        keeper.update(state, head, interaction::Seconds(31));
        keeper.finish(state, head);
        EXPECT_FALSE(std::filesystem::exists(path)) << "nothing has changed";
        state.grid = true;
        keeper.update(state, head, interaction::Seconds(32));
        keeper.finish(state, head);
        EXPECT_TRUE(back_from(path).grid);
    }
    {
        SessionKeeper keeper(path, kept_of(state), true);
        Commands heat;
        heat.array = "heat";
        heat.isosurfaces = {{7.5, {0.2f, 0.7f, 0.9f}, 0.5f}};
        heat.picked = 0;
        heat.coloring = interaction::Coloring{.by = interaction::ColorBy::value};
        keeper.finish(state, head, {heat});
        EXPECT_EQ(read_session(path).arrays, std::vector<Commands>{heat})
            << "that alone has changed";
    }
    std::filesystem::remove(path.string());
    {
        SessionKeeper keeper(path, kept_of(state), true);
        keeper.save_now(state, head);
        keeper.finish(state, head);
        EXPECT_TRUE(back_from(path).grid) << "asked for, though nothing has changed";
        EXPECT_THAT(keeper.messages(), testing::ElementsAre("session saved: " + path.string()));
    }
    std::filesystem::remove(path.string());
    save_session(path, kept_of(state));
    state.step = 3;
    SessionKeeper second(path, start, false);
    second.finish(state, head);
    EXPECT_EQ(back_from(path).step, 3u);
    EXPECT_EQ(back_from(path.string() + ".before").step, 0u);
}

TEST(KeptSession, WhereItCannotBeKeptIsSaidWithTheReason) {
    TestFolder folder;
    EXPECT_THAT(why_not_kept(std::nullopt), testing::HasSubstr("neither HOME nor XDG_STATE_HOME"));
    const auto file = folder.write("none", "a file where a folder should be");
    EXPECT_THAT(why_not_kept(std::filesystem::path(file) / "isochron" / "a.isochron-session"),
                testing::AllOf(testing::HasSubstr("this session is not saved"),
                               testing::HasSubstr("none/isochron")));
    EXPECT_EQ(why_not_kept(folder.path() / "new" / "a.isochron-session"), "");
    EXPECT_EQ(why_not_kept("a.isochron-session"), "");
}

TEST(SessionClaim, TwoProgramsHaveAFileEachUntilTheyEnd) {
    TestFolder folder;
    const auto wanted = folder.path() / "deep" / "sphere-00.isochron-session";
    {
        const SessionClaim first(wanted);
        EXPECT_EQ(first.path(), wanted);
        {
            const SessionClaim second(wanted), third(wanted);
            EXPECT_EQ(second.path().filename(), "sphere-00-2.isochron-session");
            EXPECT_EQ(third.path().filename(), "sphere-00-3.isochron-session");
        }
        EXPECT_EQ(SessionClaim(wanted).path().filename(), "sphere-00-2.isochron-session");
    }
    EXPECT_EQ(SessionClaim(wanted).path(), wanted);
    EXPECT_TRUE(std::filesystem::is_empty(wanted.parent_path())) << "no locks are left";
}

TEST(SessionFile, ARestoredSessionShowsTheSamePixels) {
    TestFolder folder;
    const auto file = build_sphere(folder.path(), kSteps);
    const auto context = stereo::make_context(stereo::ContextKind::egl, {.size = {256, 128}});
    const auto path = folder.path() / "a.isochron-session";
    Config config = small_config();
    config.quality.mode = interaction::QualityMode::quality;
    const auto settled = [](Session& session) {
        for (int frame = 1; frame < 3; ++frame)
            session.frame(head_at_rest(frame / 60.0), {}, Waiting::for_cells);
        return session.outputs().display().read_window().rgba;
    };
    std::vector<std::uint8_t> left;
    {
        Session session(config, file, *context);
        Commands commands;
        commands.isosurfaces = {
            {{5.5, {0.2f, 0.7f, 0.9f}, 0.4f}, {9.25, {0.9f, 0.3f, 0.1f}, 1.0f}}};
        commands.step = 4;
        commands.room_from_physical = interaction::Similarity{
            {-0.31, 0.87, -1.9}, glm::normalize(glm::dquat(0.9, 0.1, 0.3, -0.2)), 0.041};
        commands.clip = interaction::ClipPlane{true, {16, 15, 15}, {1, 0, 0}};
        commands.ruler = interaction::Ruler{{{10, 10, 10}, {20, 20, 12}}};
        commands.mark = interaction::Mark{interaction::MarkedPoint{{12, 14, 16}, 4, 9.25, 12345}};
        commands.grid = true;
        session.frame(head_at_rest(0), commands, Waiting::for_cells);
        left = settled(session);
        SavedSession kept = kept_of(session.state());
        save_session(path, kept);
    }
    Session session(config, file, *context);
    const auto before = settled(session);
    session.set_state(
        state_of(read_session(path), session.state(), "0123456789abcdef", kSteps, "kept"));
    EXPECT_NE(before, left);
    EXPECT_EQ(settled(session), left);
}

/// Whatever a session may have come to: with a session of its own for each, as a new start is one.
TEST(SessionFile, NoPixelOfAnyRestoredSessionDiffers) {
    TestFolder folder;
    const auto file = build_sphere(folder.path(), kSteps);
    const auto context = stereo::make_context(stereo::ContextKind::egl, {.size = {256, 128}});
    const auto path = folder.path() / "a.isochron-session";
    interaction::Random random(test_seed());
    const auto picture = [&](const ExplorerState& state) {
        Session session(small_config(), file, *context);
        session.set_state(state);
        for (int frame = 0; frame < 3; ++frame)
            session.frame(head_at_rest(frame / 60.0), {}, Waiting::for_cells);
        return session.outputs().display().read_window().rgba;
    };
    std::size_t differing = 0;
    std::set<std::vector<std::uint8_t>> pictures;
    constexpr int kSessions = 12;
    for (int i = 0; i < kSessions; ++i) {
        ExplorerState state;
        Commands commands = interaction::random_commands(random);
        commands.room_from_physical = interaction::Similarity{
            {-0.6, 0.9, -1.9}, glm::normalize(glm::dquat(0.9, 0.1, 0.3, 0.1 * i)), 0.04};
        commands.isosurfaces = {{{3.0 + 0.5 * i, {0.2f, 0.7f, 0.9f}, i % 2 ? 0.4f : 1.0f}}};
        commands.isovalue.reset();
        commands.array.reset(); // the index has one
        commands.leaving.reset();
        state.apply(commands, kSteps);
        state.playback.playing = false; // time goes on while it plays
        state.quality = interaction::QualityMode::quality;
        save_session(path, kept_of(state));
        const auto before = picture(state), after = picture(back_from(path));
        for (std::size_t at = 0; at < before.size(); at += 4)
            differing += !std::equal(&before[at], &before[at] + 4, &after[at]);
        pictures.insert(before);
    }
    std::printf("%d restored sessions, %zu pictures: %zu pixels differ\n", kSessions,
                pictures.size(), differing);
    EXPECT_GT(pictures.size(), kSessions / 2u);
    EXPECT_EQ(differing, 0u);
}

} // namespace
} // namespace isochron::app
