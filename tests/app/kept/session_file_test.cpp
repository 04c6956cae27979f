// A resumed session is the same as the saved one, pixel by pixel.
#include "app/explore/kept_session.h"
#include "app/kept/earlier_sessions.h"
#include "app/kept/session_claim.h"
#include "app/kept/session_file.h"
#include "app/kept/session_picture.h"
#include "app/loop/session_keeper.h"
#include "index/error.h"
#include "interaction/navigation/key_frames.h"
#include "tests/interaction/recording/random_commands.h"
#include "tests/support/session_fixture.h"
#include "tests/support/test_seed.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>

namespace isochron::app {
namespace {

using interaction::Commands;

constexpr std::size_t kSteps = 6;

SavedSession kept_of(const ExplorerState& state) {
    return {"isochron test",
            "/data/sphere.isochron",
            "0123456789abcdef",
            interaction::kept_state(state.as_commands()),
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
    EXPECT_THAT(complaint(with("{\n", "{\n\"picture\": \"!\",\n")), HasSubstr("base64"));
    EXPECT_EQ(complaint(with("{\n", "{\n\"name\": \"draft\", \"opened\": \"/data\",\n")),
              "no error");
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

/// A session of its own on one day, which drops what `sessions_to_drop` says.
void explore_on_day(const std::filesystem::path& path, const ExplorerState& end, std::size_t day,
                    const std::string& name = {}) {
    std::vector<std::filesystem::path> drops;
    for (const EarlierSession& each : sessions_to_drop(sessions_of(path), path))
        drops.push_back(each.path);
    SavedSession start = kept_of({});
    start.only_looked = true;
    {
        SessionKeeper keeper(path, start, false, drops);
        if (!name.empty()) {
            keeper.set_name(name);
            keeper.save_now(end, start.head);
        }
        keeper.finish(end, start.head);
    }
    make_older(path, day);
}

TEST(SessionKeeper, LosesNoWorkByAnyNumberOfLooks) {
    TestFolder folder;
    const auto path = folder.path() / "a.isochron-session";
    ExplorerState work, look;
    work.set_isovalue(7.5);
    explore_on_day(path, work, 0);
    for (std::size_t i = 0; i < kMostSessions + 5; ++i) {
        look.instant = index::Instant(1 + i % 2);
        look.room_from_physical.translation.x += 0.1;
        explore_on_day(path, look, 100 + i);
        const std::size_t most = std::min(i + 2, kMostSessions);
        ASSERT_EQ(sessions_of(path).size(), most) << i;
    }
    EXPECT_TRUE(read_session(path).only_looked);
    const auto with_work = [&] {
        return std::ranges::count(sessions_of(path), false,
                                  [](const auto& each) { return each.session.only_looked; });
    };
    EXPECT_EQ(with_work(), 1);
    for (std::size_t i = 0; i < kMostSessions + 5; ++i) {
        work.set_isovalue(static_cast<double>(i));
        explore_on_day(path, work, 200 + i);
    }
    EXPECT_EQ(with_work(), kMostSessions) << "the newest ones, and no look";
    EXPECT_EQ(back_from(sessions_of(path).front().path).isovalue(), kMostSessions + 4);
}

TEST(SessionKeeper, DropsNoneThatHasANameOrMarks) {
    TestFolder folder;
    const auto path = folder.path() / "a.isochron-session";
    ExplorerState state;
    explore_on_day(path, state, 0, "draft");
    const std::vector<std::function<void(ExplorerState&)>> marks{
        [](ExplorerState& one) { one.mark.point.emplace(); },
        [](ExplorerState& one) { one.rulers.list.emplace_back(); },
        [](ExplorerState& one) {
            one.bookmarks.push_back({.name = "x", .instant = index::Instant(1)});
        }};
    for (std::size_t i = 0; i < marks.size(); ++i) {
        ExplorerState marked;
        marks[i](marked);
        explore_on_day(path, marked, 1 + i);
    }
    for (std::size_t i = 0; i < kMostSessions + 10; ++i) {
        state.set_isovalue(static_cast<double>(i));
        explore_on_day(path, state, 10 + i);
    }
    const auto all = sessions_of(path);
    EXPECT_EQ(all.size(), kMostSessions);
    EXPECT_EQ(std::ranges::count_if(all, [](const auto& each) { return is_lasting(each.session); }),
              4);
    for (std::size_t i = 0; i < kMostSessions + 2; ++i)
        explore_on_day(path, state, 100 + i, fmt::format("draft {}", i));
    EXPECT_EQ(sessions_of(path).size(), kMostSessions + 6) << "all of them last";
}

TEST(SessionKeeper, DropsNoneOfAnotherWindowAndNoneThatGotANameMeanwhile) {
    TestFolder folder;
    const auto path = folder.path() / "a.isochron-session";
    ExplorerState state;
    for (std::size_t i = 0; i < kMostSessions; ++i) {
        state.set_isovalue(static_cast<double>(i + 1));
        explore_on_day(path, state, i);
    }
    const auto oldest = sessions_of(path).back().path;
    ASSERT_EQ(sessions_to_drop(sessions_of(path), path).front().path, oldest);
    {
        const SessionClaim other(oldest);
        EXPECT_NE(sessions_to_drop(sessions_of(path), path).front().path, oldest);
    }
    SavedSession named = read_session(oldest);
    named.name = "draft";
    save_session(oldest, named);
    drop_sessions({oldest, folder.path() / "gone.isochron-session"});
    EXPECT_TRUE(std::filesystem::exists(oldest));
}

TEST(SessionKeeper, TwoLooksWithoutAnAnswerLeaveEachSessionUnderItsOwnName) {
    TestFolder folder;
    const auto path = folder.path() / "a.isochron-session";
    ExplorerState work, look;
    work.set_isovalue(7.5);
    explore_on_day(path, work, 1);
    for (std::size_t day : {2, 3}) {
        look.room_from_physical.translation.x += 0.1;
        explore_on_day(path, look, day);
    }
    const auto all = sessions_of(path);
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(back_from(all.back().path).isovalue(), 7.5);
    EXPECT_EQ(words_of(all.back()).find("looked"), std::string::npos);
}

TEST(SessionKeeper, SavesUnderItsNameAndTakesThePlaceOfTheSessionWithThatName) {
    TestFolder folder;
    const auto path = folder.path() / "a.isochron-session";
    ExplorerState first, second;
    first.set_isovalue(7.5);
    second.set_isovalue(8.5);
    explore_on_day(path, first, 0, "draft");
    explore_on_day(path, second, 1);
    const auto draft = sessions_of(path).back();
    ASSERT_EQ(draft.session.name, "draft");
    const SavedSession start = kept_of({});
    SessionKeeper keeper(path, start, false);
    keeper.go_on_with({.words = {}, .name = "draft", .file = draft.path}, ExplorerState(),
                      start.head);
    keeper.update(first, start.head, interaction::Seconds(31));
    first.set_isovalue(7.75);
    keeper.finish(first, start.head);
    EXPECT_EQ(sessions_of(path).size(), 3u) << "nobody has asked to save to it";
    EXPECT_EQ(read_session(path).name, "");
    keeper.save_now(first, start.head);
    keeper.finish(first, start.head);
    const auto all = sessions_of(path);
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all.front().session.name, "draft");
    EXPECT_EQ(back_from(all.front().path).isovalue(), 7.75);
    EXPECT_EQ(back_from(all.back().path).isovalue(), 8.5);
    EXPECT_THAT(keeper.messages(), testing::Contains("session saved as draft: " + path.string()));
}

TEST(SessionKeeper, GoingOnWithAnotherSessionKeepsTheWorkBefore) {
    TestFolder folder;
    const auto path = folder.path() / "a.isochron-session";
    ExplorerState work, other;
    work.set_isovalue(7.5);
    other.set_isovalue(3.5);
    const SavedSession start = kept_of({});
    SessionKeeper keeper(path, start, false);
    keeper.set_name("mine");
    keeper.save_now(work, start.head);
    work.set_isovalue(7.75);
    keeper.go_on_with({.words = {}, .file = "other"}, work, start.head);
    keeper.finish(other, start.head);
    const auto all = sessions_of(path);
    ASSERT_EQ(all.size(), 2u);
    for (const EarlierSession& each : all) {
        EXPECT_EQ(back_from(each.path).isovalue(), each.path == path ? 3.5 : 7.75);
        EXPECT_EQ(each.session.name, each.path == path ? "" : "mine");
    }
}

TEST(SessionKeeper, ACrashBetweenTheFilesLosesNoSession) {
    TestFolder folder;
    const auto path = folder.path() / "a.isochron-session";
    ExplorerState state;
    for (std::size_t i = 0; i < kMostSessions; ++i) {
        state.set_isovalue(static_cast<double>(i + 1));
        explore_on_day(path, state, i);
    }
    const auto before = sessions_of(path);
    // The last one has its date, and the new one is not there yet.
    keep_earlier(path);
    EXPECT_EQ(sessions_of(path).size(), before.size());
    // The new one is there, and none has been dropped.
    save_session(path, kept_of(state));
    EXPECT_EQ(sessions_of(path).size(), kMostSessions + 1);
    explore_on_day(path, {}, kMostSessions, "next");
    EXPECT_EQ(sessions_of(path).size(), kMostSessions) << "two were dropped";
}

TEST(SessionKeeper, KeepsASmallPictureOfWhatWasSeen) {
    TestFolder folder;
    const auto path = folder.path() / "a.isochron-session";
    render::Image seen{.width = 640, .height = 480, .rgba = {}};
    for (int i = 0; i < 640 * 480; ++i)
        seen.rgba.insert(seen.rgba.end(),
                         {static_cast<std::uint8_t>(i % 640 < 320 ? 200 : 40),
                          static_cast<std::uint8_t>(i / 640 < 240 ? 10 : 90), 7, 255});
    SavedSession start = kept_of({});
    SessionKeeper keeper(path, start, false);
    keeper.show(std::make_shared<render::Image>(seen));
    ExplorerState state;
    state.grid = true;
    const auto reads_pictures = [] {
        std::ifstream maps("/proc/self/maps");
        return std::string(std::istreambuf_iterator(maps), {}).find("OpenImageIO") !=
               std::string::npos;
    };
    const bool before = reads_pictures();
    keeper.finish(state, start.head);
    EXPECT_EQ(reads_pictures(), before) << "loading that may take longer than a signal leaves";
    const auto picture = picture_in(read_session(path).picture);
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->width, 133); // 640 x 480 in 160 x 100
    EXPECT_EQ(picture->height, 100);
    EXPECT_EQ(picture->rgba, made_small(seen).rgba);
    EXPECT_EQ(std::vector(picture->at(10, 10), picture->at(10, 10) + 3),
              (std::vector<std::uint8_t>{200, 10, 7}));
    EXPECT_EQ(std::vector(picture->at(120, 90), picture->at(120, 90) + 3),
              (std::vector<std::uint8_t>{40, 90, 7}));
    EXPECT_LT(std::filesystem::file_size(path), 100'000u);
}

TEST(SessionPicture, Base64IsThatOfTheStandard) {
    const std::vector<std::pair<std::string, std::string>> rows{// RFC 4648, section 10
                                                                {"", ""},
                                                                {"f", "Zg=="},
                                                                {"fo", "Zm8="},
                                                                {"foo", "Zm9v"},
                                                                {"foob", "Zm9vYg=="},
                                                                {"fooba", "Zm9vYmE="},
                                                                {"foobar", "Zm9vYmFy"}};
    for (const auto& [bytes, text] : rows) {
        EXPECT_EQ(to_base64(bytes), text);
        EXPECT_EQ(from_base64(text), bytes);
    }
    for (const char* const wrong : {"Zg=", "Z===", "Zg==Zg==", "Zm9!", "====", "Z"})
        EXPECT_EQ(from_base64(wrong), std::nullopt) << wrong;
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
        commands.exporting.reset(); // ends with the program, and has a sign in the room
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
