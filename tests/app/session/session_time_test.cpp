// Ranges, steps left out, ways to and fro and bookmarks: recorded, replayed, undone and saved.
#include "app/loop/replay.h"
#include "interaction/controls/desktop_emulation.h"
#include "tests/support/session_fixture.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::Key;

class SessionTime : public SessionTest {
  protected:
    /// What led to a session's frames, as a recording.
    class Player {
      public:
        explicit Player(Session& session) : session_(session) {
            recording_.header.start = session.state().as_commands();
        }
        /// @param told what comes besides the devices' commands @return what is shown
        std::optional<index::SurfacesQuery>
        frame(const std::vector<interaction::WindowEvent>& events = {}, const Commands& told = {}) {
            interaction::RecordedFrame frame;
            emulation_.feed(events);
            frame.input = emulation_.poll(interaction::Seconds(now_ += 0.1));
            frame.commands = session_.commands_from(frame.input);
            interaction::merge(frame.commands, told);
            const auto shown =
                session_.frame(frame.input, frame.commands, Waiting::for_cells).shown;
            shown_.push_back(session_.state().instant.step);
            recording_.frames.push_back(std::move(frame));
            return shown;
        }
        /// A key together with Ctrl, or alone.
        void tap(Key key, bool control = true) {
            if (control)
                frame({interaction::KeyEvent{Key::left_control, true}});
            frame({interaction::KeyEvent{key, true}});
            frame({interaction::KeyEvent{key, false}});
            if (control)
                frame({interaction::KeyEvent{Key::left_control, false}});
        }
        const interaction::Recording& recording() const { return recording_; }
        const std::vector<std::uint32_t>& shown() const { return shown_; }

      private:
        Session& session_;
        interaction::DesktopEmulation emulation_{{}};
        interaction::Recording recording_;
        std::vector<std::uint32_t> shown_;
        double now_ = 0;
    };

    /// A range of steps 1 to 4 of 6, played to and fro at four steps a second, and a bookmark.
    static void play(Player& player) {
        player.tap(Key::right, false);
        player.tap(Key::comma);
        for (int i = 0; i < 3; ++i)
            player.tap(Key::right, false);
        player.tap(Key::period);
        player.tap(static_cast<Key>('B'));
        player.tap(static_cast<Key>('L'));
        player.tap(static_cast<Key>('R'));
        player.tap(Key::space, false);
        for (int i = 0; i < 60; ++i)
            player.frame();
    }
};

INSTANTIATE_TEST_SUITE_P(Contexts, SessionTime,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

TEST_P(SessionTime, AReplayShowsTheSameSteps) {
    Session session(small_config(), file_, *context_);
    Player player(session);
    play(player);
    EXPECT_EQ(session.state().play_range, (interaction::StepRange{1, 4}));
    EXPECT_THAT(session.state().bookmarks,
                testing::ElementsAre(interaction::Bookmark{"step 5", index::Instant(4)}));
    std::vector<std::uint32_t> late(player.shown().end() - 60, player.shown().end());
    late.erase(std::unique(late.begin(), late.end()), late.end());
    EXPECT_THAT(late, testing::Contains(1u));
    EXPECT_THAT(late, testing::Each(testing::AllOf(testing::Ge(1u), testing::Le(4u))));
    for (std::size_t i = 1; i < late.size(); ++i)
        EXPECT_EQ(late[i] > late[i - 1] ? late[i] - late[i - 1] : late[i - 1] - late[i], 1u);

    Session again(small_config(), file_, *context_);
    again.set_state(start_of(player.recording().header, again.state(), 6, {}));
    std::vector<std::uint32_t> replayed;
    const auto different = replay_fixed_step(again, player.recording(),
                                             {.from_devices = true, .stereo = {}, .quality = {}},
                                             [&](std::size_t, const interaction::RecordedFrame&) {
                                                 replayed.push_back(again.state().instant.step);
                                             });
    EXPECT_THAT(different, testing::IsEmpty());
    EXPECT_EQ(replayed, player.shown());
    EXPECT_EQ(again.state(), session.state());
}

TEST_P(SessionTime, AGapIsHeldWhileTimePlaysAndShownToWhoeverAsksForIt) {
    MovingSphere series(6);
    series.info().missing_after = {2};
    build_index(series, folder_.path() / "gap.isochron", {});
    Session session(small_config(), index::IndexFile::open(folder_.path() / "gap.isochron"),
                    *context_);
    Player player(session);
    player.tap(static_cast<Key>('T')); // blends
    player.tap(Key::space, false);
    std::set<std::uint32_t> blended, seen;
    for (int i = 0; i < 110; ++i) { // a round takes 10 s
        player.frame();
        const index::Instant shown = session.log().frames().back().shown->instant;
        seen.insert(shown.step);
        if (shown.between())
            blended.insert(shown.step);
    }
    EXPECT_THAT(seen, testing::ElementsAre(0, 1, 2, 3, 4, 5));
    EXPECT_THAT(blended, testing::ElementsAre(0, 1, 3, 4));
    player.tap(Key::space, false);
    Commands there;
    there.instant = {2, 20'000};
    EXPECT_EQ(session.frame(head_at_rest(100), there, Waiting::for_cells).shown->instant,
              index::Instant(2, 20'000));
}

/// As a simulation writes them: what is not there yet is not blended.
TEST_P(SessionTime, BlendsOnlyBetweenStepsThatAreThere) {
    Session session(small_config(), file_, *context_);
    Player player(session);
    player.tap(static_cast<Key>('T')); // blends
    const auto at = [&](const Commands& commands) { return player.frame({}, commands)->instant; };
    Commands last;
    last.follow = true;
    last.steps = 6;
    last.instant = {5, 30'000};
    EXPECT_EQ(at(last), index::Instant(5)) << "the last step holds";
    EXPECT_EQ(session.state().shown_instant(), index::Instant(5));
    player.tap(Key::left, false); // back to step 4, and plays to the end of what is there
    player.tap(Key::space, false);
    std::vector<index::Instant> played;
    while (played.empty() || played.back().step >= 4)
        played.push_back(at({}));
    EXPECT_GT(std::ranges::count_if(
                  played, [](index::Instant one) { return one.between() && one.step == 4; }),
              5);
    EXPECT_GT(std::ranges::count(played, index::Instant(5)), 5) << "for as long as steps last";
    EXPECT_TRUE(std::ranges::none_of(
        played, [](index::Instant one) { return one.between() && one.step == 5; }));

    // The next step arrives while the end is shown.
    while (session.state().instant.step != 5)
        at({});
    session.grow(build_sphere(folder_.path(), 7));
    EXPECT_EQ(at({}), index::Instant(5)) << "a step counts when the commands tell of it";
    Commands more;
    more.steps = 7;
    at(more);
    EXPECT_TRUE(at({}).between());
    EXPECT_EQ(session.state().instant.step, 5u);
    Commands asked;
    asked.instant = {5, 30'000};
    player.tap(Key::space, false);
    EXPECT_EQ(at(asked), index::Instant(5, 30'000));
}

TEST_P(SessionTime, ChangesAreUndoneAndTurningRoundIsNone) {
    Session session(small_config(), file_, *context_);
    Player player(session);
    play(player);
    const auto undo = [&] { player.tap(static_cast<Key>('Z')); };
    undo(); // playing
    EXPECT_FALSE(session.state().playback.playing);
    undo(); // the unit of the speed
    EXPECT_EQ(session.state().playback.unit, interaction::SpeedUnit::series);
    undo();
    EXPECT_FALSE(session.state().playback.ping_pong);
    undo();
    EXPECT_THAT(session.state().bookmarks, testing::IsEmpty());
    undo();
    EXPECT_EQ(session.state().play_range, (interaction::StepRange{1, {}}));
}

/// Sum of the differences of all colors.
std::uint64_t change_between(const render::Image& a, const render::Image& b) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        sum += static_cast<std::uint64_t>(std::abs(int{a.rgba[i]} - int{b.rgba[i]}));
    return sum;
}

TEST_P(SessionTime, NothingJumpsAtAStepAndAMomentThatIsAStepIsItsPicture) {
    Config config = small_config();
    config.quality.settled = render::Footprint::surface;
    Session session(config, file_, *context_);
    double now = 0;
    const auto picture = [&](interaction::BetweenSteps between, index::Instant at) {
        Commands commands;
        commands.between = between;
        commands.bounding_box = false;
        commands.isovalue = 8.0;
        commands.instant = at;
        for (int i = 0; i < 40; ++i) {
            session.frame(head_at_rest(now += 0.1), commands, Waiting::for_cells);
            commands = {};
            if (session.log().frames().back().final)
                break;
        }
        EXPECT_EQ(session.log().frames().back().shown->instant, at);
        return session.outputs().display().read_eye(stereo::Eye::left);
    };
    constexpr std::uint32_t kEach = index::Instant::kFractions / 16; // at a tenth of the speed
    std::vector<std::uint64_t> changes;
    std::uint64_t into = 0, out_of = 0;
    render::Image before = picture(interaction::BetweenSteps::blend, {1, 8 * kEach});
    for (std::uint32_t i = 9; i <= 24; ++i) {
        const index::Instant at(1 + i / 16, i % 16 * kEach);
        const render::Image after = picture(interaction::BetweenSteps::blend, at);
        changes.push_back(change_between(before, after));
        if (i == 16)
            into = changes.back();
        if (i == 17)
            out_of = changes.back();
        if (!at.between())
            EXPECT_EQ(picture(interaction::BetweenSteps::hold, at).rgba, after.rgba);
        before = after;
    }
    std::ranges::nth_element(changes, changes.begin() + changes.size() / 2);
    const auto median = static_cast<double>(changes[changes.size() / 2]);
    EXPECT_GT(median, 0);
    EXPECT_LE(static_cast<double>(std::max(into, out_of)), 1.5 * median);
    // The last moment before a step shows what the step shows.
    const auto last =
        picture(interaction::BetweenSteps::blend, {1, index::Instant::kFractions - 1});
    const auto step = picture(interaction::BetweenSteps::blend, index::Instant(2));
    EXPECT_LE(static_cast<double>(change_between(last, step)), 0.1 * median);
}

TEST_P(SessionTime, MomentsBetweenStepsAreShownRecordedReplayedAndUndone) {
    Session session(small_config(), file_, *context_);
    Player player(session);
    player.tap(static_cast<Key>('T')); // blends
    player.tap(Key::space, false);
    std::vector<index::Instant> shown;
    for (int i = 0; i < 40; ++i) {
        player.frame();
        shown.push_back(session.log().frames().back().shown->instant);
    }
    EXPECT_GT(std::ranges::count_if(shown, &index::Instant::between), 20);
    for (std::size_t i = 1; i < shown.size(); ++i)
        EXPECT_NE(shown[i], shown[i - 1]); // every frame has its moment

    Session again(small_config(), file_, *context_);
    again.set_state(start_of(player.recording().header, again.state(), 6, {}));
    std::vector<index::Instant> replayed;
    const auto different = replay_fixed_step(
        again, player.recording(), {.from_devices = true, .stereo = {}, .quality = {}},
        [&](std::size_t, const interaction::RecordedFrame&) {
            replayed.push_back(again.log().frames().back().shown->instant);
        });
    EXPECT_THAT(different, testing::IsEmpty());
    EXPECT_TRUE(std::equal(shown.begin(), shown.end(),
                           replayed.end() - static_cast<std::ptrdiff_t>(shown.size())));
    EXPECT_EQ(again.state(), session.state());

    player.tap(Key::space, false); // stops
    Commands there;
    there.instant = {4, 555};
    Commands next;
    next.instant = index::Instant(2);
    session.frame(head_at_rest(100), there, Waiting::for_cells);
    session.frame(head_at_rest(101), next, Waiting::for_cells);
    EXPECT_EQ(session.state().shown_instant(), index::Instant(2));
    const ExplorerState now = session.state();
    ExplorerState before = now;
    before.instant = {4, 555};
    ExplorerState undone = now;
    undone.apply(now.commands_to(before), 6);
    EXPECT_EQ(undone.shown_instant(), index::Instant(4, 555));
    undone.quality = interaction::QualityMode::paper;
    EXPECT_EQ(undone.shown_instant(), index::Instant(4));
    undone.quality = interaction::QualityMode::automatic;
    undone.steps = 5; // the last one that the session knows holds
    EXPECT_EQ(undone.shown_instant(), index::Instant(4));
}

} // namespace
} // namespace isochron::app
