// The session: a frame does all that it should, and never waits.
#include "tests/support/eventually.h"
#include "tests/support/gate.h"
#include "tests/support/session_fixture.h"

#include "app/loop/replay.h"
#include "index/error.h"

#include <gmock/gmock.h>

#include <future>
#include <latch>
#include <utility>

#include <unistd.h>

namespace isochron::app {
namespace {

using interaction::Commands;

INSTANTIATE_TEST_SUITE_P(Contexts, SessionTest,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

/// Pixels that differ from the background in the corner.
std::size_t drawn_pixels(const render::Image& image) {
    std::size_t count = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (std::memcmp(image.at(x, y), image.at(0, 0), 3) != 0)
                ++count;
    return count;
}

TEST_P(SessionTest, ShowsTheCellsThatWereAskedFor) {
    Session session(small_config(), file_, *context_);
    Commands commands;
    commands.isovalue = 8.0;
    commands.instant = index::Instant(3);
    const FrameReport report = session.frame(head_at_rest(0), commands, Waiting::for_cells);
    ASSERT_TRUE(report.shown.has_value());
    EXPECT_EQ(*report.shown, (index::SurfacesQuery{index::Instant(3), {8.0}}));
    EXPECT_GT(report.cells, 500u);
    EXPECT_GT(drawn_pixels(session.outputs().display().read_window()), 1000u);
}

TEST_P(SessionTest, ReportsTheReusedCellsOfTheShownSet) {
    const index::Extract real = index::extract_from(file_);
    const index::Extract extract = [&](const index::SurfacesQuery& query, std::stop_token stop) {
        auto found = std::make_shared<index::Extraction>(*real(query, stop));
        found->surfaces.front().reused = 100 + query.instant.step;
        return found;
    };
    Session session(small_config(), file_, *context_, extract);
    Commands commands;
    for (const std::uint32_t step : {2u, 3u}) {
        commands.instant = index::Instant(step);
        EXPECT_EQ(session.frame(head_at_rest(step), commands, Waiting::for_cells).reused,
                  100 + step);
    }
}

TEST_P(SessionTest, GoesOnWithAnIndexThatGrows) {
    Session session(small_config(), file_, *context_);
    const auto asked = [](std::uint32_t steps, std::uint32_t step) {
        Commands commands;
        commands.isovalue = 8.0;
        commands.steps = steps;
        commands.instant = index::Instant(step);
        return commands;
    };
    session.frame(head_at_rest(0), asked(6, 5), Waiting::for_cells);
    EXPECT_EQ(session.frame(head_at_rest(1), asked(8, 7), Waiting::for_cells).shown->instant,
              index::Instant(5))
        << "there are no more";
    build_sphere(folder_.path(), 8);
    // Another process of the cluster has told so.
    const FrameReport told = session.frame(head_at_rest(2), asked(8, 7), Waiting::for_cells);
    EXPECT_EQ(told.shown->instant, index::Instant(7));
    EXPECT_GT(told.cells, 100u);
    session.grow(build_sphere(folder_.path(), 9));
    Commands late;
    late.instant = index::Instant(8);
    EXPECT_EQ(session.frame(head_at_rest(3), late, Waiting::for_cells).shown->instant,
              index::Instant(7))
        << "a step counts when the commands tell of it";
    const FrameReport grown = session.frame(head_at_rest(4), asked(9, 8), Waiting::for_cells);
    EXPECT_EQ(grown.shown->instant, index::Instant(8));
    EXPECT_EQ(session.state().steps, 9u);
}

TEST_P(SessionTest, FramesGoOnWhileAnExtractionHangs) {
    std::latch entered(1);
    std::promise<void> release;
    const std::shared_future<void> released = release.get_future().share();
    const index::Extract extract = [&](const index::SurfacesQuery& query, std::stop_token) {
        entered.count_down();
        released.wait();
        auto extraction = std::make_shared<index::Extraction>();
        extraction->query = query;
        return extraction;
    };
    Session session(small_config(), file_, *context_, extract);
    session.frame(head_at_rest(0), {}, Waiting::never);
    entered.wait();
    for (int frame = 1; frame <= 50; ++frame) {
        Commands commands;
        commands.isovalue = 4.0 + 0.1 * frame;
        EXPECT_FALSE(session.frame(head_at_rest(frame / 60.0), commands, Waiting::never).shown);
    }
    release.set_value();
    EXPECT_EQ(session.frame(head_at_rest(1), {}, Waiting::for_cells).shown,
              (index::SurfacesQuery{index::Instant(0), {9.0}}));
}

// Were a frame to wait for the worker, the test would not come to an end.
TEST_P(SessionTest, AnExtractionThatTakesLongLeavesTheFramesAsTheyAre) {
    const index::Extract real = index::extract_from(file_);
    test_support::Gate gate;
    std::latch entered(1);
    const index::Extract extract = [&](const index::SurfacesQuery& query, std::stop_token stop) {
        if (query.instant == index::Instant(1)) {
            entered.count_down();
            gate.pass();
        }
        return real(query, stop);
    };
    Session session(small_config(), file_, *context_, extract);
    session.frame(head_at_rest(0), {}, Waiting::for_cells);
    Commands commands;
    const auto frame = [&]() -> FrameReport { // with a head that moves, so that it is drawn
        const std::size_t number = session.log().frames().size();
        interaction::InputState input = head_at_rest(0.01 * static_cast<double>(number));
        input.devices[0].pose->position.x = 0.01f * static_cast<float>(number % 20);
        return session.frame(input, std::exchange(commands, {}), Waiting::never);
    };
    commands.instant = index::Instant(1);
    frame();
    entered.wait();
    for (int i = 0; i < 600; ++i) {
        const FrameReport report = frame();
        EXPECT_EQ(report.shown->instant, index::Instant(0));
        EXPECT_TRUE(report.redrawn);
        EXPECT_EQ(report.wait, Milliseconds(0));
    }
    gate.open();
    EXPECT_TRUE(
        test_support::eventually([&] { return frame().shown->instant == index::Instant(1); }));
}

TEST_P(SessionTest, FramesGoOnWhileAReadStalls) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const index::Extract extract = [&](const index::SurfacesQuery& query, std::stop_token) {
        char byte;
        EXPECT_EQ(::read(ends[0], &byte, 1), 1); // blocks in the kernel until the byte arrives
        auto extraction = std::make_shared<index::Extraction>();
        extraction->query = query;
        return extraction;
    };
    Session session(small_config(), file_, *context_, extract);
    for (int frame = 0; frame < 50; ++frame)
        EXPECT_FALSE(session.frame(head_at_rest(frame / 60.0), {}, Waiting::never).shown);
    ASSERT_EQ(::write(ends[1], "x", 1), 1);
    EXPECT_TRUE(session.frame(head_at_rest(1), {}, Waiting::for_cells).shown);
    close(ends[0]);
    close(ends[1]);
}

TEST_P(SessionTest, AFailingExtractionLeavesThePictureAndSaysWhy) {
    const index::Extract real = index::extract_from(file_);
    const index::Extract extract = [&](const index::SurfacesQuery& query, std::stop_token stop) {
        if (query.instant == index::Instant(2))
            throw std::runtime_error("step 2 cannot be read");
        return real(query, stop);
    };
    Session session(small_config(), file_, *context_, extract);
    const auto cells = session.frame(head_at_rest(0), {}, Waiting::for_cells).cells;
    Commands to_step_2;
    to_step_2.instant = index::Instant(2);
    const FrameReport report = session.frame(head_at_rest(0.1), to_step_2, Waiting::for_cells);
    EXPECT_EQ(report.cells, cells);
    EXPECT_EQ(report.shown->instant, index::Instant(0));
    EXPECT_EQ(session.failure(), "step 2 cannot be read");
}

TEST_P(SessionTest, AReplayEndsWithAnErrorWhereCellsAreNotFound) {
    const index::Extract extract = [](const index::SurfacesQuery&,
                                      const std::stop_token&) -> index::ExtractionPtr {
        throw std::runtime_error("step 0 cannot be read");
    };
    Session session(small_config(), file_, *context_, extract);
    interaction::Recording recording;
    recording.frames.push_back({head_at_rest(0), {}, {}});
    int pictures = 0;
    EXPECT_THROW(
        replay_fixed_step(session, recording, {}, [&](std::size_t, const auto&) { ++pictures; }),
        index::Error);
    EXPECT_EQ(pictures, 0);
}

TEST_P(SessionTest, SettlesIntoSplatsAndMovesInQuads) {
    Session session(small_config(), file_, *context_);
    FrameReport report;
    for (int frame = 0; frame < 30; ++frame)
        report = session.frame(head_at_rest(frame / 60.0), {}, Waiting::for_cells);
    EXPECT_EQ(report.footprint, render::kBestFootprint);
    Commands drag;
    drag.isovalue = 7.0;
    EXPECT_EQ(session.frame(head_at_rest(0.6), drag, Waiting::for_cells).footprint,
              render::Footprint::quad);
}

TEST_P(SessionTest, OnlyAChangeIsDrawnAgain) {
    Session session(small_config(), file_, *context_);
    EXPECT_TRUE(session.frame(head_at_rest(0), {}, Waiting::for_cells).redrawn);
    const auto picture = session.outputs().display().read_window().rgba;
    EXPECT_FALSE(session.frame(head_at_rest(0.01), {}, Waiting::for_cells).redrawn);
    EXPECT_EQ(session.outputs().display().read_window().rgba, picture);
    interaction::InputState nod = head_at_rest(0.02);
    nod.devices[0].pose->position.y += 0.001f;
    EXPECT_TRUE(session.frame(nod, {}, Waiting::for_cells).redrawn);
    Commands wider;
    wider.eye_separation = 0.07f;
    EXPECT_TRUE(session.frame(nod, wider, Waiting::for_cells).redrawn);
}

TEST_P(SessionTest, ACaptureWaitsForQuality) {
    Session session(small_config(), file_, *context_);
    session.outputs().set_screenshots(folder_.path());
    Commands capture;
    capture.screenshot = true;
    capture.isovalue = 6.0;
    session.frame(head_at_rest(0), capture, Waiting::for_cells);
    session.outputs().pictures().finish();
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "isochron_0001.png"));
    for (int frame = 1; frame < 30; ++frame)
        session.frame(head_at_rest(frame / 60.0), {}, Waiting::for_cells);
    session.outputs().pictures().finish();
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "isochron_0001.png"));
}

TEST_P(SessionTest, TheTwoEyesDifferAndWithoutSeparationTheyDoNot) {
    Session session(small_config(), file_, *context_);
    session.frame(head_at_rest(0), {}, Waiting::for_cells);
    const auto left = session.outputs().display().read_eye(stereo::Eye::left);
    const auto right = session.outputs().display().read_eye(stereo::Eye::right);
    EXPECT_NE(left.rgba, right.rgba);
    Commands together;
    together.eye_separation = 0.0f;
    session.frame(head_at_rest(0.01), together, Waiting::for_cells);
    EXPECT_EQ(session.outputs().display().read_eye(stereo::Eye::left).rgba,
              session.outputs().display().read_eye(stereo::Eye::right).rgba);
}

/// A minute's worth of somebody playing and turning, made from devices through the controls.
interaction::Recording record_something(Session& session) {
    interaction::Recording recording;
    recording.header.start = session.state().as_commands();
    interaction::DesktopEmulation emulation({});
    for (int frame = 0; frame < 60; ++frame) {
        std::vector<interaction::WindowEvent> events;
        if (frame == 3)
            events.push_back(interaction::KeyEvent{interaction::Key::space, true});
        if (frame == 4)
            events.push_back(interaction::KeyEvent{interaction::Key::space, false});
        if (frame == 10)
            events.push_back(interaction::MouseButtonEvent{interaction::MouseButton::left, true});
        const auto sweep = static_cast<float>(frame);
        events.push_back(interaction::MouseMoveEvent{0.3f + 0.005f * sweep, 0.4f, 640, 480});
        emulation.feed(events);
        interaction::RecordedFrame recorded;
        recorded.input = emulation.poll(interaction::Seconds(frame / 30.0));
        recorded.commands = session.commands_from(recorded.input);
        session.frame(recorded.input, recorded.commands, Waiting::for_cells);
        recording.frames.push_back(recorded);
    }
    return recording;
}

TEST_P(SessionTest, AReplayGivesTheSamePicturesAndTheSameCells) {
    interaction::Recording recording;
    {
        Session session(small_config(), file_, *context_);
        recording = record_something(session);
    }
    std::vector<std::vector<std::uint8_t>> pictures[2];
    std::vector<std::uint64_t> cells[2];
    for (int run = 0; run < 2; ++run) {
        Session session(small_config(), file_, *context_);
        session.set_state(start_of(recording.header, session.state(), 6, {}));
        const auto different = replay_fixed_step(
            session, recording, {.from_devices = true, .stereo = {}, .quality = {}},
            [&](std::size_t, const interaction::RecordedFrame&) {
                pictures[run].push_back(session.outputs().display().read_window().rgba);
                cells[run].push_back(session.log().frames().back().cells);
            });
        EXPECT_THAT(different, testing::IsEmpty());
    }
    EXPECT_EQ(cells[0], cells[1]);
    EXPECT_EQ(pictures[0], pictures[1]);
    EXPECT_NE(pictures[0].front(), pictures[0].back()) << "nothing happened in the recording";
}

TEST_P(SessionTest, ALiveReplayObeysEveryCommandAndKeepsTheLimitOfFrames) {
    interaction::Recording recording;
    for (int i = 0; i <= 20; ++i) {
        Commands commands;
        commands.isovalue = 1.0 + 0.1 * i;
        recording.frames.push_back({head_at_rest(0.01 * i), commands, {}});
    }
    Session session(small_config(), file_, *context_);
    replay_live(session, recording, {}, 25.0);
    EXPECT_EQ(session.state().isovalue(), 3.0);
    EXPECT_LE(session.log().frames().size(), 7u) << "0.2 s, and a frame at each end";
}

TEST_P(SessionTest, AChangedCommandIsReportedWithItsFrame) {
    interaction::Recording recording;
    {
        Session session(small_config(), file_, *context_);
        recording = record_something(session);
    }
    recording.frames[20].commands.isovalue = 3.25;
    Session session(small_config(), file_, *context_);
    session.set_state(start_of(recording.header, session.state(), 6, {}));
    const auto different =
        replay_fixed_step(session, recording, {.from_devices = true, .stereo = {}, .quality = {}},
                          [](std::size_t, const interaction::RecordedFrame&) {});
    ASSERT_FALSE(different.empty());
    EXPECT_THAT(different.front(), testing::HasSubstr("frame 20"));
    EXPECT_THAT(different.front(), testing::HasSubstr("isovalue"));
}

} // namespace
} // namespace isochron::app
