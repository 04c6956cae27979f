// Ranges, steps left out, ways to and fro and bookmarks: recorded, replayed, undone and saved.
#include "app/session/kept/session_file.h"
#include "app/session/replay.h"
#include "interaction/controls/desktop_emulation.h"
#include "tests/support/session_fixture.h"

#include <gmock/gmock.h>

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
        void frame(const std::vector<interaction::WindowEvent>& events = {}) {
            interaction::RecordedFrame frame;
            emulation_.feed(events);
            frame.input = emulation_.poll(interaction::Seconds(now_ += 0.1));
            frame.commands = session_.commands_from(frame.input);
            session_.frame(frame.input, frame.commands, Waiting::for_cells);
            shown_.push_back(session_.state().step);
            recording_.frames.push_back(std::move(frame));
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
                testing::ElementsAre(interaction::Bookmark{"step 5", 4}));
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
                                                 replayed.push_back(again.state().step);
                                             });
    EXPECT_THAT(different, testing::IsEmpty());
    EXPECT_EQ(replayed, player.shown());
    EXPECT_EQ(again.state(), session.state());
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

TEST_P(SessionTime, ASavedSessionKeepsThem) {
    Session session(small_config(), file_, *context_);
    Player player(session);
    play(player);
    const auto path = folder_.path() / "kept.isochron-session";
    save_session(path, {"isochron test", "sphere", "00", session.state().as_commands(), {}});
    EXPECT_EQ(state_of(read_session(path), {}, "00", 6, "kept"), session.state());
}

} // namespace
} // namespace isochron::app
