// The exact picture at rest in parts: the same as the whole, to the bit, and given up for input.
#include "tests/support/eventually.h"
#include "tests/support/session_fixture.h"

#include "stereo/context/gl_context_backends.h"

#include <functional>
#include <string>

namespace isochron::app {
namespace {

using interaction::Commands;
using render::Footprint;
using stereo::Eye;
using stereo::StereoMode;

class Parts : public SessionTest {
  protected:
    /// Frames have time for one piece each, and no footprint but quads fits.
    static Config partial(StereoMode mode = StereoMode::side_by_side) {
        Config config = small_config(mode);
        config.rendering.frame_rate_limit = 60;
        config.quality.frame_budget_ms = 1e-6;
        config.quality.still_budget_ms = 1e-6;
        config.rendering.samples = 1;
        return config;
    }
    FrameReport frame(Session& session, const Commands& commands = {}, double head = 0) {
        interaction::InputState input = head_at_rest(frame_++ / 60.0);
        input.devices[0].pose->position.x = static_cast<float>(head);
        return session.frame(input, commands, Waiting::never);
    }
    /// Many frames at rest, or until one is as wanted: the worker may take its time.
    bool rests_until(Session& session, const std::function<bool(const FrameReport&)>& wanted,
                     double head = 0) {
        return test_support::eventually([&] {
            for (int i = 0; i < 50; ++i)
                if (wanted(frame(session, {}, head)))
                    return true;
            return false;
        });
    }
    /// Frames at rest until the picture is final. @return how many
    int settle(Session& session) {
        const int first = frame_;
        EXPECT_TRUE(rests_until(session, &FrameReport::final));
        return frame_ - first;
    }
    /// Frames at rest until parts are made. @return whether they are
    bool begin_parts(Session& session) {
        return rests_until(session, [](const FrameReport& report) {
            return report.in_parts && report.footprint != *report.in_parts;
        });
    }
    /// Shows a surface of some thousand cells.
    void start(Session& session, Commands commands = {}) {
        if (!commands.isosurfaces)
            commands.isovalue = 2.0;
        session.frame(head_at_rest(frame_++ / 60.0), commands, Waiting::for_cells);
    }
    /// Every picture that a session shows.
    static std::vector<std::vector<std::uint8_t>> pictures(const Session& session) {
        const stereo::Display& display = session.outputs().display();
        std::vector<std::vector<std::uint8_t>> all{display.read_window().rgba};
        for (const Eye eye : stereo::eyes_of(display.mode()))
            all.push_back(display.read_eye(eye).rgba);
        if (stereo::upright(display.mode()) == StereoMode::quadbuffer)
            all.push_back(display.read_right_buffer().rgba);
        return all;
    }
    /// A session that draws each picture at once, as a replay does.
    Session at_once(Config config, Footprint footprint = Footprint::surface) const {
        config.quality.settled = footprint;
        return Session(config, file_, *context_);
    }
    std::vector<std::vector<std::uint8_t>> whole(Session& at_once, const Commands& commands) {
        for (int i = 0; i < 30; ++i)
            at_once.frame(head_at_rest(replayed_++ / 60.0), i == 0 ? commands : Commands{},
                          Waiting::for_cells);
        return pictures(at_once);
    }
    /// That a session which has come to rest shows what one shows that draws it at once.
    void expect_whole(const Session& session, Session& at_once) {
        Commands same;
        same.isovalue = 2.0;
        EXPECT_EQ(pictures(session), whole(at_once, same));
    }
    int frame_ = 0, replayed_ = 0;
};

INSTANTIATE_TEST_SUITE_P(, Parts,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

TEST_P(Parts, GiveTheWholePictureToTheBitInEveryStereoMode) {
    const Config config = partial();
    Session session(config, file_, *context_), reference = at_once(config);
    start(session);
    for (const StereoMode mode : stereo::all_stereo_modes()) {
        SCOPED_TRACE(stereo::name_of(mode));
        Commands commands;
        commands.isovalue = 2.0;
        commands.stereo = stereo::name_of(mode);
        EXPECT_FALSE(frame(session, commands).final);
        EXPECT_GT(settle(session), 3);
        const FrameReport& report = session.log().frames().back();
        EXPECT_EQ(report.footprint, Footprint::surface);
        EXPECT_EQ(report.reason, QualityReason::in_parts);
        EXPECT_FALSE(report.redrawn);
        EXPECT_EQ(pictures(session), whole(reference, commands));
        EXPECT_EQ(reference.log().frames().back().footprint, Footprint::surface);
    }
}

TEST_P(Parts, GiveTheWholePictureOfTranslucentSurfacesAndOfSeveralSamples) {
    const auto expect_whole = [&](int samples, float opacity) {
        SCOPED_TRACE(testing::Message() << samples << " samples, opacity " << opacity);
        Config config = partial();
        config.rendering.samples = samples;
        Commands commands;
        commands.isosurfaces = {
            {{2.0, {0.9f, 0.3f, 0.2f}, opacity}, {8.0, {0.2f, 0.5f, 0.9f}, 1.0f}}};
        Session session(config, file_, *context_), reference = at_once(config);
        start(session, commands);
        EXPECT_GT(settle(session), 3);
        EXPECT_EQ(session.log().frames().back().footprint, Footprint::surface);
        EXPECT_TRUE(pictures(session) == whole(reference, commands));
    };
    expect_whole(1, 0.4f);
    expect_whole(4, 1.0f);
    // Mesa 22.3's zink draws a translucent surface on four samples as on one if it is drawn at
    // once, so that the edges of its cells show. In parts it does not.
    if (stereo::describe_current(context_->loader()).find("zink") == std::string::npos)
        expect_whole(4, 0.4f);
}

TEST_P(Parts, EndAtWhatIsConfiguredForAPictureAtRest) {
    Config config = partial();
    config.quality.settled = Footprint::gaussian;
    Session session(config, file_, *context_);
    Session reference = at_once(config, Footprint::gaussian);
    start(session);
    settle(session);
    EXPECT_EQ(session.log().frames().back().footprint, Footprint::gaussian);
    expect_whole(session, reference);
}

TEST_P(Parts, ShowNothingUntilTheyAreWhole) {
    Session session(partial(), file_, *context_);
    start(session);
    ASSERT_TRUE(begin_parts(session));
    const auto before = pictures(session);
    FrameReport report;
    int frames = 0;
    do {
        EXPECT_EQ(pictures(session), before);
        report = frame(session);
        ++frames;
    } while (!report.redrawn && frames < 1000);
    EXPECT_GT(frames, 3);
    EXPECT_EQ(report.footprint, Footprint::surface);
    EXPECT_NE(pictures(session), before);
}

TEST_P(Parts, GoOnWhereOnlyWhatLiesOverTheCellsChanges) {
    Session session(partial(), file_, *context_);
    start(session);
    ASSERT_TRUE(begin_parts(session));
    Commands commands;
    commands.bounding_box = false;
    const FrameReport report = frame(session, commands);
    EXPECT_TRUE(report.in_parts);
    EXPECT_TRUE(report.redrawn) << "the box is gone at once";
    EXPECT_TRUE(rests_until(session, &FrameReport::final, 0));
    Session reference(partial(), file_, *context_);
    start(reference);
    frame(reference, commands);
    EXPECT_TRUE(rests_until(reference, &FrameReport::final, 0));
    EXPECT_EQ(pictures(session), pictures(reference));
}

TEST_P(Parts, AreGivenUpInTheFrameThatChangesSomething) {
    const std::function<void(Commands&, double&)> changes[] = {
        [](Commands&, double& head) { head = 0.2; },
        [](Commands& commands, double&) {
            commands.look.emplace().background = interaction::Background::light;
        },
        [](Commands& commands, double&) { commands.stereo = "top_bottom"; },
        [](Commands& commands, double&) { commands.instant = index::Instant(1); }};
    for (const auto& change : changes) {
        SCOPED_TRACE(&change - changes);
        Config config = partial();
        config.memory.mesh_megabytes = 0; // a mesh in motion is of live pictures alone
        Session session(config, file_, *context_);
        start(session);
        ASSERT_TRUE(begin_parts(session));
        frame(session);
        Commands commands;
        double head = 0;
        change(commands, head);
        FrameReport report = frame(session, commands, head);
        EXPECT_FALSE(report.in_parts);
        EXPECT_NE(report.footprint, Footprint::surface);
        EXPECT_TRUE(report.redrawn || commands.instant) << "the cells of another step come later";
        if (!commands.instant) {
            // At rest a load of other programs that ends may be the time to try splats. A moving
            // picture of a replay has quads.
            Session fresh = at_once(config, report.footprint);
            Commands same;
            same.isovalue = 2.0;
            for (int i = 0; i < 30; ++i)
                fresh.frame(head_at_rest(i / 60.0), i == 0 ? same : Commands{}, Waiting::for_cells);
            interaction::InputState input = head_at_rest(0.5);
            input.devices[0].pose->position.x = static_cast<float>(head);
            const FrameReport& whole = fresh.frame(input, commands, Waiting::for_cells);
            EXPECT_EQ(whole.pace, report.pace);
            ASSERT_EQ(whole.footprint, report.footprint);
            EXPECT_EQ(pictures(session), pictures(fresh)) << "nothing of the parts is left";
        }
        EXPECT_TRUE(rests_until(session, &FrameReport::final, head));
        EXPECT_EQ(session.log().frames().back().footprint, Footprint::surface) << "they begin anew";
    }
}

TEST_P(Parts, AreNotMadeWithoutABudgetAtRestNorInFastAndPaperModeNorInAReplay) {
    for (const interaction::QualityMode mode :
         {interaction::QualityMode::automatic, interaction::QualityMode::fast,
          interaction::QualityMode::paper}) {
        Config config = partial();
        config.start.quality = mode;
        if (mode == interaction::QualityMode::automatic)
            config.quality.still_budget_ms = 0;
        Session session(config, file_, *context_);
        start(session);
        for (int i = 0; i < 120; ++i)
            EXPECT_FALSE(frame(session).in_parts);
    }
    Session session(partial(), file_, *context_);
    for (int i = 0; i < 60; ++i)
        EXPECT_FALSE(session.frame(head_at_rest(i / 60.0), {}, Waiting::for_cells).in_parts);
    EXPECT_EQ(session.log().frames().back().footprint, Footprint::surface);
}

TEST_P(Parts, AreNotMadeOfSurfacesThatSlicesHide) {
    Session session(partial(StereoMode::mono), file_, *context_);
    start(session);
    Commands slices;
    slices.slices = interaction::Slices{.planes = {{}}, .alone = true};
    frame(session, slices);
    int in_parts = 0;
    EXPECT_TRUE(rests_until(session, [&](const FrameReport& report) {
        in_parts += report.in_parts.has_value();
        return report.final && report.footprint == render::kBestFootprint;
    }));
    EXPECT_EQ(in_parts, 0);
    slices.slices->alone = false;
    frame(session, slices);
    EXPECT_TRUE(begin_parts(session)) << "the surfaces are back";
}

TEST_P(Parts, GiveTheWholePictureInEveryViewport) {
    Config config = partial();
    std::vector<stereo::Viewport>& viewports = config.installation.windows.front().viewports;
    viewports.push_back(viewports.front());
    for (std::size_t i = 0; i < viewports.size(); ++i) {
        viewports[i].size = {0.5f, 1.0f};
        viewports[i].position = {0.5f * static_cast<float>(i), 0.0f};
    }
    Session session(config, file_, *context_), reference = at_once(config);
    start(session);
    settle(session);
    EXPECT_EQ(session.log().frames().back().reason, QualityReason::in_parts);
    expect_whole(session, reference);
}

TEST_P(Parts, TellWhatThePictureCostsThatNoFrameHasDrawn) {
    Session session(partial(), file_, *context_);
    start(session);
    ASSERT_TRUE(begin_parts(session));
    EXPECT_FALSE(session.log().frames().back().better) << "not known yet";
    settle(session);
    const std::optional<Milliseconds> cost = session.log().frames().back().expected;
    ASSERT_TRUE(cost);
    EXPECT_GT(cost->count(), 0);
}

TEST_P(Parts, TellWhatTheExactPictureCosts) {
    Config config = partial();
    config.quality.frame_budget_ms = 60000; // all fits once it is known to, on any machine
    Session session(config, file_, *context_);
    start(session);
    settle(session);
    const FrameReport report = frame(session, {}, 0.3);
    EXPECT_EQ(report.pace, interaction::Pace::moving);
    EXPECT_EQ(report.footprint, Footprint::surface) << "known to fit before anything moved";
}

} // namespace
} // namespace isochron::app
