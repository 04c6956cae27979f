// The live loop on a stand-in for a desktop: how many frames it makes and presents, and what ends its
// waits. The clock goes on by a frame's time in each frame, and while the loop waits as far as the
// test says.
#include "tests/support/session_fixture.h"

#include "app/command_line/cancel.h"
#include "app/control/control_client.h"
#include "app/loop/live_loop.h"
#include "app/loop/live_recording.h"
#include "app/loop/new_steps.h"
#include "app/loop/session_control.h"
#include "app/loop/session_keeper.h"
#include "index/indexing/appended_series.h"
#include "index/system/growing_file.h"
#include "index/system/team.h"
#include "tests/support/eventually.h"
#include "tests/support/memory_series.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <fcntl.h>
#include <filesystem>
#include <future>
#include <string>
#include <unistd.h>
#include <utility>

namespace isochron::app {
namespace {

using interaction::Key;
using interaction::KeyEvent;
using interaction::MouseMoveEvent;
using interaction::Seconds;
using interaction::WindowEvent;

constexpr Seconds kFrame{1.0 / 60};

/// The number by which this process has a file open; -1: it has not.
int open_as(const std::filesystem::path& path) {
    std::error_code gone; // a file that another thread closes meanwhile
    for (int number = 0; number < 1024; ++number)
        if (std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(number), gone) == path)
            return number;
    return -1;
}

/// A window that counts what it presents. What happens while the loop waits is up to the test.
class CountingWindow final : public stereo::GlContext {
  public:
    using Wait = std::function<void(const stereo::Wake&, Seconds longest)>;

    CountingWindow() : context_(stereo::make_context(stereo::ContextKind::egl, {.size = kSize})) {}
    void make_current() override { context_->make_current(); }
    render::GlLoader loader() const override { return context_->loader(); }
    glm::ivec2 framebuffer_size() const override { return kSize; }
    bool has_window() const override { return true; }
    void present() override { ++presents; }
    bool should_close() const override { return false; }
    std::vector<WindowEvent> poll_events() override { return std::exchange(events, {}); }
    void wait(const stereo::Wake& wake, Seconds longest) override { waits(wake, longest); }
    bool take_damage() override { return std::exchange(damaged, false); }
    std::string description() const override { return "counting"; }

    std::vector<WindowEvent> events;
    bool damaged = false;
    int presents = 0;
    Wait waits;

  private:
    static constexpr glm::ivec2 kSize{640, 480};
    std::unique_ptr<stereo::GlContext> context_;
};

/// One step of a test: what happens while the loop waits.
using Happening = std::function<void(const stereo::Wake&, Seconds longest)>;

class IdleLoop : public testing::Test {
  protected:
    IdleLoop() : file_(build_sphere(folder_.path())) {
        config_ = read_config(test_support::source_root() + "/configs/desktop.toml");
        config_.installation.windows.front().size = window_.framebuffer_size();
        config_.rendering.frame_rate_limit = 1000;
    }

    /// Runs the loop: the happenings come one after another, each in a wait of the loop; then it ends.
    void run(std::vector<Happening> happenings) {
        session_.emplace(config_, file_, window_);
        session_->set_state(start_ ? start_(session_->state()) : session_->state());
        session_->outputs().set_screenshots(folder_.path());
        bool ends = false;
        window_.waits = [&](const stereo::Wake& wake, Seconds longest) {
            since_wait_ = {.presents =
                               window_.presents - std::exchange(presented_, window_.presents),
                           .frames = frames_ - std::exchange(made_, frames_)};
            if (next_ == happenings.size())
                ends = true;
            else
                happenings[next_++](wake, longest);
        };
        LiveOptions options;
        options.clock = [this] { return now_; };
        options.ended = [&] {
            ++frames_;
            now_ += kFrame;
            return ends || (each_frame_ && each_frame_());
        };
        LiveLoop live(config_, {}, options);
        session_->set_clock(live.clock());
        if (prepare_)
            prepare_(live);
        live.run(*session_);
        live.finish(*session_);
    }
    void record(LiveLoop& live, const std::shared_ptr<LiveRecording>& recording) {
        recording->begin(folder_.path() / "walk.jsonl", {});
        live.join(CompanionPlace::recording, recording);
    }
    void press(Key key) {
        window_.events.push_back(KeyEvent{key, true});
        window_.events.push_back(KeyEvent{key, false});
    }
    const FrameReport& last() const { return session_->log().frames().back(); }

    TestFolder folder_;
    std::shared_ptr<const index::IndexFile> file_;
    CountingWindow window_;
    Config config_;
    std::optional<Session> session_;
    Seconds now_{0};
    std::size_t next_ = 0; ///< happening
    int frames_ = 0, made_ = 0, presented_ = 0;
    struct {
        int presents = 0, frames = 0;
    } since_wait_; ///< between the last two waits
    std::function<ExplorerState(ExplorerState)> start_;
    std::function<void(LiveLoop&)> prepare_;
    std::function<bool()> each_frame_; ///< true: the loop ends
};

TEST_F(IdleLoop, WaitsForGoodOnceThePictureIsFinalAndPresentsNothingUntilSomethingChanges) {
    const auto nothing = [&](const stereo::Wake&, Seconds longest) {
        EXPECT_EQ(longest, FrameOutlook::kNever);
        EXPECT_TRUE(last().final);
        EXPECT_EQ(last().shown, last().asked);
        now_ += Seconds(600);
    };
    run({nothing, nothing, nothing});
    EXPECT_EQ(since_wait_.frames, 1 + IdleWait::kFramesAfter) << "of which one ends the wait";
    EXPECT_EQ(since_wait_.presents, 0);
}

TEST_F(IdleLoop, RecordsNoMoreOnceAFrameCouldNotBeWritten) {
    const auto recording = std::make_shared<LiveRecording>();
    prepare_ = [&](LiveLoop& live) {
        record(live, recording);
        EXPECT_TRUE(recording->records());
        // As if the disk were full from here on.
        const int written = open_as(folder_.path() / "walk.jsonl.part");
        const int full = ::open("/dev/full", O_WRONLY | O_CLOEXEC);
        ASSERT_TRUE(written >= 0 && full >= 0);
        EXPECT_EQ(::dup3(full, written, O_CLOEXEC), written);
        ::close(full);
    };
    start_ = [](ExplorerState state) {
        state.playback.playing = true; // so that there are frames all the time
        return state;
    };
    constexpr int kMany = 100'000;
    bool stopped = false;
    each_frame_ = [&] {
        stopped = !recording->records();
        return stopped || frames_ > kMany;
    };
    EXPECT_ANY_THROW(run({})) << "the end says it, too";
    EXPECT_TRUE(stopped);
}

TEST_F(IdleLoop, AStillWindowHasGivenAllOfItsRecordingToTheSystem) {
    prepare_ = [&](LiveLoop& live) { record(live, std::make_shared<LiveRecording>()); };
    const auto lines = [&] {
        const std::string text = folder_.read("walk.jsonl.part");
        return std::ranges::count(text, '\n') - 1; // without the header
    };
    const auto wait_for_all = [&](auto&, Seconds longest) {
        EXPECT_EQ(longest, FrameOutlook::kNever) << "nothing wakes it for that";
        EXPECT_TRUE(test_support::eventually([&] { return lines() >= frames_; }));
    };
    run({wait_for_all,
         [&](auto& wake, Seconds longest) {
             wait_for_all(wake, longest);
             press(Key{'H'});
         },
         [&](auto& wake, Seconds longest) {
             wait_for_all(wake, longest);
             EXPECT_THAT(folder_.read("walk.jsonl.part"), testing::HasSubstr("\"grid\":true"));
         }});
}

TEST_F(IdleLoop, AKeyBringsFramesUntilTheNewPictureIsFinal) {
    run({[&](auto&, Seconds) { press(Key{'H'}); },
         [&](auto&, Seconds longest) {
             EXPECT_TRUE(session_->state().grid);
             EXPECT_GE(since_wait_.presents, 1);
             EXPECT_TRUE(last().final);
             EXPECT_EQ(longest, FrameOutlook::kNever);
         }});
    EXPECT_EQ(since_wait_.presents, 0);
}

TEST_F(IdleLoop, CellsThatAreAskedForAreShownBeforeItWaitsAgain) {
    const auto asked = [&] { return last().asked.isovalues.front(); };
    double before = 0;
    run({[&](auto&, Seconds) {
             before = asked();
             press(Key::up);
         },
         [&](auto&, Seconds) {
             EXPECT_NE(asked(), before);
             EXPECT_EQ(last().shown, last().asked);
             EXPECT_TRUE(last().final);
         }});
}

TEST_F(IdleLoop, ACursorThatMovesIsFollowed) {
    run({[&](auto&, Seconds) { window_.events.push_back(MouseMoveEvent{0.8f, 0.5f, 640, 480}); },
         [&](auto&, Seconds) {
             EXPECT_GE(since_wait_.frames, 2 + IdleWait::kFramesAfter);
             EXPECT_LE(since_wait_.presents, since_wait_.frames);
         }});
}

TEST_F(IdleLoop, AMessageFromTheBackgroundWakesAndGoesWhenItsTimeIsOver) {
    run({[&](auto&, Seconds) { press(Key{'P'}); },
         [&](const stereo::Wake& wake, Seconds longest) {
             if (longest == FrameOutlook::kNever) {                 // the picture is being written
                 wake.wait(-1, std::chrono::duration<double>(1e9)); // the test's limit ends a hang
                 wake.take();
                 --next_;
                 return;
             }
             EXPECT_GE(since_wait_.presents, 1) << "the message is there";
             EXPECT_LT(longest, Seconds(30));
             now_ += longest;
         },
         [&](auto&, Seconds longest) {
             EXPECT_GE(since_wait_.presents, 1) << "the message is gone";
             EXPECT_EQ(longest, FrameOutlook::kNever);
         }});
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "isochron_0001.png"));
}

TEST_F(IdleLoop, ASignalEndsTheWait) {
    const CancelOnSignal signals;
    std::optional<WakeOnSignal> ends;
    prepare_ = [&](LiveLoop& live) { ends.emplace(live.wake(), stereo::Wake::call); };
    each_frame_ = [] { return CancelOnSignal::received() != 0; };
    bool again = false;
    run({[&](const stereo::Wake& wake, Seconds) {
             std::raise(SIGTERM);
             wake.wait(-1, std::chrono::duration<double>(1e9));
             EXPECT_TRUE(wake.take());
         },
         [&](auto&, Seconds) { again = true; }});
    EXPECT_FALSE(again);
    EXPECT_EQ(CancelOnSignal::received(), SIGTERM);
}

TEST_F(IdleLoop, WhatTheWindowSystemLostIsPresentedOnceAndNotDrawn) {
    run({[&](auto&, Seconds) { window_.damaged = true; },
         [&](auto&, Seconds) {
             EXPECT_EQ(since_wait_.presents, 1);
             EXPECT_FALSE(last().redrawn);
         }});
}

TEST_F(IdleLoop, DoesNotWaitWhileAKeyIsHeldOrTimePlays) {
    int left = 100, waits = 0;
    start_ = [](ExplorerState state) {
        state.playback.playing = state.playback.loop = true;
        return state;
    };
    each_frame_ = [&] { return --left == 0; };
    run({[&](auto&, Seconds) { ++waits; }});
    EXPECT_EQ(waits, 0) << "time plays";

    start_ = {};
    left = -1;
    const auto hold = [&](auto&, Seconds) {
        window_.events.push_back(KeyEvent{Key::left_shift, true});
        left = 200;
    };
    run({hold, [&](auto&, Seconds) { ++waits; }});
    EXPECT_EQ(waits, 0) << "a key is held";
}

TEST_F(IdleLoop, TimePlaysOnFromWhenItWasAskedForAndNotFromWhenTheWaitBegan) {
    int left = -1;
    unsigned missed = 0;
    double rate = 0;
    each_frame_ = [&] {
        if (left > 0 && !session_->log().frames().empty())
            missed = std::max(missed, last().missed);
        return --left == 0;
    };
    config_.quality.frame_budget_ms = 1000 * kFrame.count();
    const std::uint32_t steps = static_cast<std::uint32_t>(file_->info().steps());
    run({[&](auto&, Seconds) {
        now_ += Seconds(3600);
        press(Key::space);
        left = 6;
    }});
    rate = session_->log().frames_per_second(120);
    EXPECT_TRUE(session_->state().playback.playing);
    EXPECT_EQ(session_->state().instant, index::Instant(0))
        << "of " << steps << ", a second or more apart";
    EXPECT_EQ(missed, 0u);
    EXPECT_NEAR(rate, 1 / kFrame.count(), 1);
}

TEST_F(IdleLoop, WakesToSaveTheSession) {
    prepare_ = [&](LiveLoop& live) {
        live.join(CompanionPlace::keeper, std::make_shared<SessionKeeper>(
                                              folder_.path() / "kept.json", SavedSession{}, false));
    };
    run({[&](auto&, Seconds longest) {
             EXPECT_LE(longest, SessionKeeper::kInterval);
             now_ += longest;
         },
         [&](auto&, Seconds longest) { EXPECT_LE(longest, SessionKeeper::kInterval); }});
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "kept.json"));
}

TEST_F(IdleLoop, APictureForAClientShowsWhatTheClientToldBeforeHoweverLongTheLoopHasWaited) {
    std::shared_ptr<SessionControl> control;
    std::shared_ptr<const stereo::Wake> wake;
    prepare_ = [&](LiveLoop& live) {
        control = std::make_shared<SessionControl>(
            control_address((folder_.path() / "control.sock").string()), *session_,
            ControlServerOptions{});
        live.join(CompanionPlace::control, control);
        wake = live.wake();
    };
    std::future<std::string> answer;
    std::atomic<bool> answered{false};
    const auto ask = [&](double isovalue) {
        ControlClient client(control->server().address());
        ControlRequest command{.verb = ControlVerb::commands};
        command.commands.isovalue = isovalue;
        client.ask(command);
        const auto picture = client.ask({.verb = ControlVerb::picture});
        answered = true;
        (*wake)();
        return picture.line;
    };
    const auto begin = [&](double isovalue) {
        return [&, isovalue](const stereo::Wake& woken, Seconds) {
            now_ += kAnHour;
            answer = std::async(std::launch::async, ask, isovalue);
            woken.wait(-1, std::chrono::duration<double>(1e9)); // the test's limit ends a hang
            woken.take();
        };
    };
    const auto end = [&](double isovalue) {
        return [&, isovalue](const stereo::Wake& woken, Seconds) {
            if (!answered.exchange(false)) {
                woken.wait(-1, std::chrono::duration<double>(1e9));
                woken.take();
                --next_;
                return;
            }
            const std::string line = answer.get();
            EXPECT_THAT(line, testing::HasSubstr(fmt::format(R"(\"isovalue\":{:.1f})", isovalue)));
            EXPECT_THAT(line, testing::HasSubstr(R"(\"footprint\":\"surface\")"));
        };
    };
    run({begin(4), end(4), begin(6), end(6)});
    EXPECT_EQ(next_, 4u);
}

/// The first steps of a growing index, which keeps its values' range.
index::StepValues first_steps(const index::TestField& field, std::size_t steps) {
    index::StepValues values = field.view();
    values.steps = steps;
    return values;
}

TEST_F(IdleLoop, NewStepsWakeIt) {
    const index::TestField field({32, 32, 32}, 9, index::ValueType::u8, index::moving_sphere);
    const auto path = folder_.path() / "growing.isochron";
    index::MemorySeries begun(first_steps(field, 6));
    build_index(begun, path, {});
    file_ = index::IndexFile::open(path);
    prepare_ = [&](LiveLoop& live) {
        live.join(CompanionPlace::watch, std::make_shared<NewSteps>(path, file_, live.waker()));
    };
    start_ = [](ExplorerState state) {
        state.follow = true;
        return state;
    };
    bool added = false;
    run({[&](const stereo::Wake& wake, Seconds) {
        if (session_->state().steps == 9)
            return;
        if (!std::exchange(added, true)) {
            index::GrowingFile file(path, true);
            const auto series = index::append_to(
                file_, "growing", std::make_unique<index::MemorySeries>(field.view()));
            append_index(*series, *file_, file, path, {}, {}, *index::alone());
        }
        wake.wait(-1, std::chrono::duration<double>(1e9)); // the test's limit ends a hang
        wake.take();
        --next_; // it may have been an earlier call, which came late
    }});
    EXPECT_EQ(session_->state().instant, index::Instant(8));
    EXPECT_EQ(last().shown, last().asked);
}

} // namespace
} // namespace isochron::app
