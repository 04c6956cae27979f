// A resumed session is the same as the saved one, pixel by pixel.
#include "app/explore/kept_session.h"
#include "app/kept/earlier_sessions.h"
#include "app/kept/session_claim.h"
#include "app/kept/session_file.h"
#include "app/loop/session_keeper.h"
#include "index/error.h"
#include "tests/interaction/recording/random_commands.h"
#include "tests/support/session_fixture.h"
#include "tests/support/test_seed.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
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

std::vector<EarlierSession> sessions_of(const std::filesystem::path& path) {
    return sessions_in(path.parent_path(),
                       [&](const std::string& name) { return is_session_of(name, path); });
}

/// As if it had been saved long ago, on one day after the other.
void make_older(const std::filesystem::path& path, std::size_t day) {
    constexpr std::size_t kDays = 1000;
    std::filesystem::last_write_time(path, std::filesystem::last_write_time(path) -
                                               std::chrono::hours(24 * (kDays - day)));
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
        SavedSession saved = kept_of(state);
        saved.reading = static_cast<std::uint32_t>(round);
        save_session(path, saved);
        EXPECT_EQ(read_session(path).reading, saved.reading);
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
    state.instant = index::Instant(3);
    SessionKeeper second(path, start, false);
    second.finish(state, head);
    EXPECT_EQ(back_from(path).instant, index::Instant(3));
    const auto all = sessions_of(path);
    ASSERT_EQ(all.size(), 2u);
    for (const EarlierSession& each : all)
        EXPECT_EQ(back_from(each.path).instant.step, each.path == path ? 3u : 0u);
}

/// A session on its own, from the first look at the data.
void explore_once(const std::filesystem::path& path, const ExplorerState& end) {
    SavedSession start = kept_of({});
    start.only_looked = true;
    SessionKeeper keeper(path, start, false);
    keeper.finish(end, start.head);
}

TEST(SessionKeeper, LosesNoWorkByAnyNumberOfLooks) {
    TestFolder folder;
    const auto path = folder.path() / "a.isochron-session";
    ExplorerState work, look;
    work.set_isovalue(7.5);
    explore_once(path, work);
    make_older(path, 0);
    for (std::size_t i = 0; i < kMostEarlierSessions + 5; ++i) {
        look.instant = index::Instant(1 + i % 2);
        look.room_from_physical.translation.x += 0.1;
        explore_once(path, look);
        make_older(path, 100 + i);
    }
    EXPECT_TRUE(read_session(path).only_looked);
    const auto all = sessions_of(path);
    EXPECT_EQ(all.size(), kMostEarlierSessions + 1);
    const auto with_work = [&] {
        return std::ranges::count(sessions_of(path), false,
                                  [](const auto& each) { return each.session.only_looked; });
    };
    EXPECT_EQ(with_work(), 1);
    for (std::size_t i = 0; i < kMostEarlierSessions + 5; ++i) {
        work.set_isovalue(static_cast<double>(i));
        explore_once(path, work);
        make_older(path, 200 + i);
    }
    EXPECT_EQ(with_work(), kMostEarlierSessions + 1) << "the newest ones, and no look";
    EXPECT_EQ(back_from(sessions_of(path).front().path).isovalue(), kMostEarlierSessions + 4);
}

TEST(SessionKeeper, WhatGoesOnWithWorkIsWork) {
    TestFolder folder;
    const auto path = folder.path() / "a.isochron-session";
    ExplorerState state;
    state.set_isovalue(7.5);
    explore_once(path, state);
    EXPECT_FALSE(read_session(path).only_looked);
    SessionKeeper resumed(path, read_session(path), true);
    state.instant = index::Instant(2);
    resumed.finish(state, kept_of({}).head);
    EXPECT_FALSE(read_session(path).only_looked);
    EXPECT_EQ(sessions_of(path).size(), 1u) << "it takes the place of what it goes on with";
}

TEST(SessionKeeper, LeavesAnEarlierSessionThatCannotBeRenamed) {
    TestFolder folder;
    const auto path = folder.path() / std::string(250, 'a'); // with a date it is too long
    save_session(path, kept_of({}));
    ExplorerState state;
    state.instant = index::Instant(3);
    SessionKeeper keeper(path, kept_of({}), false);
    for (int twice = 0; twice < 2; ++twice) {
        state.instant.step++;
        EXPECT_THROW(keeper.finish(state, kept_of({}).head), index::Error);
        EXPECT_EQ(back_from(path).instant, index::Instant(0));
    }
}

TEST(KeptSession, EveryEarlierOneIsFoundAndTheLastComesFirst) {
    TestFolder folder;
    setenv("XDG_STATE_HOME", folder.path().c_str(), 1);
    const auto file = build_sphere(folder.path(), kSteps);
    ExploreOptions options;
    options.data = (folder.path() / "sphere.isochron").string();
    const auto path = *kept_in(options, *file);
    EXPECT_TRUE(earlier_sessions(options, *file).empty());
    ExplorerState state;
    for (int day = 0; day < 3; ++day) {
        state.instant.step++;
        explore_once(path, state);
        make_older(path, static_cast<std::size_t>(day));
    }
    const std::string name = path.stem().string();
    const auto there = [&](const std::string& file_name) {
        save_session(path.parent_path() / file_name, kept_of({}));
    };
    there(name + "-2.isochron-session");
    there(name + ".isochron-session.before"); // as version 0.2 had it
    there("sphere-0123456789abcdef.isochron-session");
    there(name + "-notes.isochron-session");
    folder.write("isochron/" + name + "-3.isochron-session", "no session");
    const auto all = earlier_sessions(options, *file);
    EXPECT_EQ(all.size(), 5u);
    EXPECT_EQ(all.front().path, path);
    EXPECT_THAT(words_of(all.front()), testing::EndsWith(", only looked at"));
    options.session = (folder.path() / "own.isochron-session").string();
    for (std::uint32_t end = 1; end < 3; ++end) {
        state.instant = index::Instant(end);
        explore_once(*options.session, state);
    }
    EXPECT_EQ(earlier_sessions(options, *file).size(), 2u);
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
    config.start.quality = interaction::QualityMode::quality;
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
        commands.instant = index::Instant(4);
        commands.room_from_physical = interaction::Similarity{
            {-0.31, 0.87, -1.9}, glm::normalize(glm::dquat(0.9, 0.1, 0.3, -0.2)), 0.041};
        commands.clip = interaction::ClipPlane{true, {16, 15, 15}, {1, 0, 0}};
        commands.ruler = interaction::Ruler{{{10, 10, 10}, {20, 20, 12}}};
        commands.mark = interaction::Mark{interaction::MarkedPoint{{12, 14, 16}, {4, 12345}, 9.25}};
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
