// The quality of a session: by measurement when live, by pace only in a fixed-step replay; captures
// wait for it.
#include "tests/app/session/quality_session.h"
#include "tests/support/eventually.h"

#include "app/loop/replay.h"
#include "stereo/image_file.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <future>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::QualityMode;
using render::Footprint;
using test_support::eventually;

INSTANTIATE_TEST_SUITE_P(Contexts, SessionQuality,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

bool is_best(const FrameReport& frame) {
    return frame.final && frame.footprint == render::kBestFootprint;
}

std::ptrdiff_t frames_with(const Session& session, Footprint footprint) {
    return static_cast<std::ptrdiff_t>(session.log().frames_with(footprint));
}

TEST_P(SessionQuality, WithinTheBudgetASettledPictureEndsAtTheBestAndIsThenLeftAlone) {
    Session session(config_with(kPlenty), file_, *context_);
    start(session);
    EXPECT_EQ(walk(session, 20).reason, QualityReason::moving);
    rest_until(session, is_best);
    const FrameReport report = rest(session, 60);
    EXPECT_EQ(report.footprint, render::kBestFootprint);
    EXPECT_EQ(report.reason, QualityReason::fits);
    EXPECT_TRUE(report.final);
    EXPECT_TRUE(report.expected.has_value());
    EXPECT_FALSE(report.redrawn) << "nothing moves";
    EXPECT_EQ(report.budget, Milliseconds(kPlenty));
}

TEST_P(SessionQuality, OverTheBudgetASettledPictureGoesBackToQuadsAndSaysWhy) {
    Session session(config_with(kNothing), file_, *context_);
    start(session);
    rest_until(session, [](const FrameReport& frame) {
        return frame.reason == QualityReason::over_budget && frame.final && frame.better;
    });
    EXPECT_GT(frames_with(session, Footprint::mesh) + frames_with(session, Footprint::surface), 0)
        << "it is not known before";
    EXPECT_EQ(frames_with(session, Footprint::gaussian), 0) << "nobody asked for it";
    const auto before = frames_with(session, Footprint::quad);
    rest(session, 6000);
    EXPECT_GT(frames_with(session, Footprint::quad) - before, 5900);
}

TEST_P(SessionQuality, APictureAtRestMayTakeItsTimeButNotOneThatSways) {
    Config config = config_with(kNothing);
    config.quality.still_budget_ms = kPlenty;
    Session session(config, file_, *context_);
    start(session);
    rest_until(session, is_best);
    FrameReport report = rest(session, 60);
    EXPECT_EQ(report.footprint, render::kBestFootprint);
    EXPECT_TRUE(report.final);
    EXPECT_EQ(report.reason, QualityReason::in_parts);
    EXPECT_FALSE(report.redrawn);
    // Settled, but every second refresh shows another pose: that of a slow tracker.
    const auto sway = [&](int frames) {
        for (int i = 0; i < frames; ++i, ++frame_) {
            interaction::InputState input = head_at_rest(now().count());
            input.devices[0].pose->position.x = 1e-5f * static_cast<float>(frame_ / 2 % 2);
            report = session.frame(input, {}, Waiting::never);
            ASSERT_EQ(report.pace, interaction::Pace::settled);
        }
    };
    sway(20);
    const std::size_t first = session.log().frames().size();
    sway(600);
    const auto& frames = session.log().frames();
    // A mesh takes about as long as quads, or it is not taken.
    EXPECT_LE(std::count_if(frames.begin() + static_cast<std::ptrdiff_t>(first), frames.end(),
                            [](const FrameReport& frame) {
                                return frame.footprint != Footprint::quad &&
                                       frame.footprint != Footprint::mesh;
                            }),
              24);
    EXPECT_EQ(report.budget, Milliseconds(kNothing));
}

/// Frames of a session in which quads take a known time, and nothing else is told.
class QuadsTake final : public FramesAlone {
  public:
    explicit QuadsTake(double ms) : time_(ms) {}
    std::vector<DrawSample> samples(std::vector<DrawSample> mine) override {
        std::erase_if(mine, [](const DrawSample& sample) {
            return sample.footprint != Footprint::quad || sample.load.cells <= 0;
        });
        for (DrawSample& sample : mine) {
            sample.processor = Milliseconds(time_);
            sample.gpu.reset();
        }
        return mine;
    }

  private:
    double time_;
};

TEST_P(SessionQuality, AHeadThatSwaysEndsAtTheExactSurfaceThoughItIsGuessedTooDear) {
    Config config = config_with(kPlenty);
    config.quality.still_budget_ms = kPlenty;
    Session session(config, file_, *context_);
    session.share_frames(std::make_unique<QuadsTake>(0.3 * kPlenty)); // which twelve times exceed
    start(session);
    FrameReport report;
    const auto sways = [&] {
        for (int i = 0; i < 20; ++i, ++frame_) {
            interaction::InputState input = head_at_rest(now().count());
            input.devices[0].pose->position.x = 1e-5f * static_cast<float>(frame_ / 2 % 2);
            report = session.frame(input, {}, Waiting::never);
            EXPECT_FALSE(report.in_parts);
        }
        return report.footprint == Footprint::surface;
    };
    EXPECT_TRUE(eventually(sways));
    EXPECT_EQ(report.pace, interaction::Pace::settled);
    EXPECT_EQ(frames_with(session, Footprint::gaussian), 0) << "which may take too long";
    sways();
    EXPECT_EQ(report.footprint, Footprint::surface);
    // What is drawn ahead leaves nothing in what is shown.
    Session whole(config, file_, *context_);
    for (int i = 0; i < 60; ++i) {
        interaction::InputState input = head_at_rest(i / kRate);
        input.devices[0].pose->position.x = 1e-5f * static_cast<float>((frame_ - 1) / 2 % 2);
        whole.frame(input, {}, Waiting::for_cells);
    }
    ASSERT_EQ(whole.log().frames().back().footprint, Footprint::surface);
    EXPECT_TRUE(session.outputs().display().read_window().rgba ==
                whole.outputs().display().read_window().rgba);
}

TEST_P(SessionQuality, TimesOfTheGpuReachTheReport) {
    Session session(config_with(kPlenty), file_, *context_);
    start(session);
    const auto& frames = session.log().frames();
    EXPECT_TRUE(eventually([&] {
        walk(session, 20);
        return std::ranges::count_if(frames,
                                     [](const auto& frame) { return frame.gpu.has_value(); }) > 20;
    }));
    EXPECT_GT(session.log().known(&FrameReport::gpu).median, 0);
}

TEST_P(SessionQuality, TheVolumeOfCellsInMotionFollowsWhenThePictureComesToRest) {
    const render::Gl gl(context_->loader());
    // Otherwise normals are made of the volume, which comes with every set.
    const bool follows = render::CellBuffers::wanted_shading(gl) != index::Shading::none;
    Config config = config_with(kPlenty);
    config.rendering.upload_kilobytes_per_frame = 16; // less than a set's
    Session session(config, file_, *context_);
    start(session);
    const index::Instant before = session.log().frames().back().shown->instant;
    const auto first = session.log().frames().size();
    Commands commands;
    commands.instant = index::Instant(before.step + 1);
    ASSERT_TRUE(eventually([&] { return walk(session, 1, commands).shown->instant != before; }));
    walk(session, 5);
    const auto& frames = session.log().frames();
    std::uint64_t in_motion = 0;
    for (auto i = first; i < frames.size(); ++i)
        in_motion += frames[i].uploaded.block_bytes;
    EXPECT_EQ(in_motion == 0, follows);
    rest_until(session, is_best);
    const auto sending = std::ranges::count_if(
        frames, [](const auto& frame) { return frame.uploaded.block_bytes > 0; });
    EXPECT_GT(sending, 2);
    for (const FrameReport& frame : frames)
        EXPECT_TRUE(frame.uploaded.block_bytes < 16 * 1024 || // as much as fits, and so not all
                    frame.pace == interaction::Pace::moving);
}

TEST_P(SessionQuality, MeshesAreMadeWhereTheyAreDrawnAndWithinTheirBudget) {
    const render::Gl gl(context_->loader());
    const bool makes = render::CellBuffers::wanted_shading(gl) != index::Shading::none;
    const auto mesh_bytes = [](const Session& session) {
        std::uint64_t bytes = 0;
        for (const FrameReport& frame : session.log().frames())
            bytes += frame.uploaded.mesh_bytes;
        return bytes;
    };
    Config config = config_with(kPlenty);
    {
        Session session(config, file_, *context_);
        start(session);
        rest_until(session, [](const FrameReport& frame) {
            return frame.footprint == Footprint::surface && frame.final;
        });
        const bool drawn =
            std::ranges::any_of(session.log().frames(), [](const FrameReport& frame) {
                return frame.footprint == Footprint::mesh;
            });
        EXPECT_TRUE(mesh_bytes(session) > 0 || !drawn) << "they may also come at rest";
        Commands fast;
        fast.quality = interaction::QualityMode::fast;
        fast.instant = index::Instant(2);
        const std::uint64_t before = mesh_bytes(session);
        walk(session, 40, fast);
        EXPECT_EQ(mesh_bytes(session), before) << "quads need none";
    }
    config.quality.settled = Footprint::mesh;
    for (const int megabytes : {96, 0}) {
        config.memory.mesh_megabytes = megabytes;
        Session session(config, file_, *context_);
        start(session);
        rest(session, 60);
        const FrameReport report =
            rest_until(session, [](const FrameReport& frame) { return frame.final; });
        const bool meshed = makes && megabytes > 0;
        EXPECT_EQ(report.footprint, meshed ? Footprint::mesh : Footprint::gaussian);
        EXPECT_TRUE(report.final);
        EXPECT_EQ(mesh_bytes(session) > 0, meshed);
    }
}

TEST_P(SessionQuality, AFixedStepReplayGoesByPaceWhateverItCosts) {
    std::vector<Footprint> footprints[2];
    for (const double budget : {kPlenty, kNothing}) {
        Session session(config_with(budget), file_, *context_);
        for (int frame = 0; frame < 60; ++frame) {
            interaction::InputState input = head_at_rest(frame / kRate);
            if (frame > 30)
                input.devices[0].pose->position.x = 0.01f * static_cast<float>(frame - 30);
            footprints[budget == kPlenty].push_back(
                session.frame(input, {}, Waiting::for_cells).footprint);
        }
    }
    EXPECT_EQ(footprints[0], footprints[1]);
    EXPECT_EQ(footprints[0][30], render::kBestFootprint);
    EXPECT_EQ(footprints[0].back(), Footprint::quad);
}

TEST_P(SessionQuality, WhatIsConfiguredForASettledPictureIsTaken) {
    Config config = config_with(kNothing);
    config.quality.settled = Footprint::gaussian;
    Session session(config, file_, *context_);
    start(session);
    const FrameReport report = rest_until(
        session, [](const FrameReport& frame) { return frame.footprint == Footprint::gaussian; });
    EXPECT_EQ(report.reason, QualityReason::configured);
}

TEST_P(SessionQuality, ACaptureInMotionIsTakenOnceThePictureIsSettled) {
    Session session(config_with(kPlenty), file_, *context_);
    session.outputs().set_screenshots(folder_.path());
    start(session);
    Commands capture;
    capture.screenshot = true;
    EXPECT_EQ(walk(session, 60, capture).pace, interaction::Pace::moving);
    EXPECT_FALSE(captured(session));
    rest_until(session, [&](const FrameReport&) { return captured(session); });
    rest(session, 60);
    // The settled picture, which nothing has changed since.
    session.outputs().kept_pictures().each([&](std::size_t, const stereo::Display& display) {
        EXPECT_EQ(stereo::read_image(folder_.path() / "isochron_0001.png").rgba,
                  display.read_window().rgba);
    });
    EXPECT_EQ(session.log().frames().back().footprint, render::kBestFootprint);
}

TEST_P(SessionQuality, ACaptureOfWhatDoesNotFitIsTakenAtWhatDoes) {
    Session session(config_with(kNothing), file_, *context_);
    session.outputs().set_screenshots(folder_.path());
    start(session);
    Commands capture;
    capture.screenshot = true;
    rest(session, 60, capture);
    // The trial of a mesh waits for one, which is made in the background.
    EXPECT_TRUE(eventually([&] {
        rest(session, 10);
        return captured(session);
    }));
}

TEST_P(SessionQuality, InFastModeACaptureIsTakenAtOnceAndFast) {
    Session session(config_with(kPlenty), file_, *context_);
    session.outputs().set_screenshots(folder_.path());
    start(session);
    Commands capture;
    capture.screenshot = true;
    capture.quality = QualityMode::fast;
    EXPECT_EQ(walk(session, 1, capture).footprint, Footprint::quad);
    EXPECT_TRUE(captured(session));
}

TEST_P(SessionQuality, TimeThatPlaysIsNotFinalAndACaptureOfItComesAllTheSame) {
    Session session(config_with(kPlenty), file_, *context_);
    session.outputs().set_screenshots(folder_.path());
    start(session);
    Commands play;
    play.screenshot = true;
    play.playback = interaction::PlaybackState{true, false, true, 1.0};
    for (int frame = 0; frame < 11 * kRate; ++frame, ++frame_) {
        Commands commands = frame == 0 ? play : Commands{};
        commands.instant = index::Instant(static_cast<std::uint32_t>(frame / 6 % 6));
        const auto report = session.frame(head_at_rest(now().count()), commands, Waiting::never);
        ASSERT_FALSE(report.final);
        if (frame == 5 * kRate) {
            EXPECT_FALSE(captured(session)) << "it may stop yet";
        }
    }
    EXPECT_TRUE(captured(session));
}

TEST_P(SessionQuality, WhileASearchHangsFramesAndQualityGoOnAndTheCaptureWaits) {
    const index::Extract real = index::extract_from(file_);
    std::promise<void> release;
    const std::shared_future<void> released = release.get_future().share();
    const index::Extract extract = [&](const index::SurfacesQuery& query, std::stop_token stop) {
        if (query.instant == index::Instant(1))
            released.wait();
        return real(query, stop);
    };
    Session session(config_with(kPlenty), file_, *context_, extract);
    session.outputs().set_screenshots(folder_.path());
    start(session);
    Commands to_step_1;
    to_step_1.instant = index::Instant(1);
    to_step_1.screenshot = true;
    const std::size_t first = session.log().frames().size();
    rest(session, static_cast<int>(2 * kRate), to_step_1);
    const auto& frames = session.log().frames();
    EXPECT_EQ(frames.size() - first, 2 * kRate);
    const FrameReport report = rest_until(session, [](const FrameReport& frame) {
        return frame.footprint == render::kBestFootprint;
    }); // for the cells that are there
    EXPECT_EQ(report.shown->instant, index::Instant(0));
    EXPECT_FALSE(captured(session)) << "these are not the cells that were asked for";
    EXPECT_EQ(session.log().missed(), 0u);
    EXPECT_TRUE(std::ranges::all_of(
        frames.begin() + static_cast<std::ptrdiff_t>(first), frames.end(),
        [](const FrameReport& frame) { return frame.wait == Milliseconds(0); }));
    release.set_value();
    session.frame(head_at_rest(now().count()), {}, Waiting::for_cells);
    ++frame_;
    EXPECT_EQ(rest(session, 1).shown->instant, index::Instant(1));
    rest_until(session, [&](const FrameReport&) { return captured(session); });
}

TEST_P(SessionQuality, RefreshesWithoutAFrameAreCounted) {
    Session session(config_with(0), file_, *context_);
    start(session);
    EXPECT_EQ(rest(session, 1).missed, 0u);
    frame_ += 3;
    EXPECT_EQ(rest(session, 1).missed, 3u);
    EXPECT_EQ(rest(session, 5).missed, 0u);
    EXPECT_EQ(session.log().missed(), 3u);
}

} // namespace
} // namespace isochron::app
