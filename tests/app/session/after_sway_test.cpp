// What moves after a head has swayed: moved pictures draw no cells, so they tell nothing of their cost.
#include "tests/app/session/large_session.h"

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

class AfterSway : public SessionDetail {
  protected:
    /// A frame with the head somewhere beside its place [m].
    FrameReport at(Session& session, double x) {
        interaction::InputState input = head_at_rest(frame_ / 60.0);
        ++frame_;
        input.devices[0].pose->position.x = static_cast<float>(x);
        return session.frame(input, {}, Waiting::never);
    }
};
INSTANTIATE_TEST_SUITE_P(Contexts, AfterSway,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

/// Frames of a session whose cells take a known time, at first much longer.
class KnownTimesOfCells final : public FramesAlone {
  public:
    explicit KnownTimesOfCells(const double& slower) : slower_(slower) {}
    std::vector<DrawSample> samples(std::vector<DrawSample> mine) override {
        constexpr double kFixed = 1, kOfCell = 2.5e-5, kFewPixels = 0.6; // ms; in two views
        for (DrawSample& sample : mine) {
            const double dear = sample.footprint == render::Footprint::surface ? 8 : 1;
            const double pixels = sample.resolution > 0 ? kFewPixels : 1;
            sample.gpu.reset();
            sample.processor =
                Milliseconds(slower_ * pixels * (kFixed + dear * kOfCell * sample.load.cells));
        }
        return mine;
    }

  private:
    const double& slower_;
};

TEST_P(AfterSway, MotionDrawsTheCellsThatFitThoughTheFirstPicturesTookMuchLonger) {
    for (const double least_resolution : {1.0, 0.35}) {
        SCOPED_TRACE(least_resolution);
        Config config = config_with(8); // holds 100,000 cells
        config.quality.still_budget_ms = 500;
        config.quality.least_resolution = least_resolution;
        config.memory.mesh_megabytes = 0;
        double slower = 8;
        Session session(config, large_, *context_);
        session.share_frames(std::make_unique<KnownTimesOfCells>(slower));
        FrameReport report = first_frame(session, false);
        ASSERT_TRUE(test_support::eventually([&] {
            report = at(session, 0);
            return report.final && report.cells > 0 &&
                   report.footprint == render::Footprint::surface;
        }));
        slower = 1;
        int moved = 0;
        for (int i = 0; i < 100; ++i)
            moved += at(session, 0.02 * std::sin(0.1 * i)).moved;
        EXPECT_GT(moved, 50);
        EXPECT_TRUE(test_support::eventually([&] {
            report = at(session, 0.2 * std::sin(0.3 * frame_));
            return !report.moved && report.cells > 60'000;
        })) << report.cells
            << " cells in resolution " << report.resolution;
    }
}

TEST_P(AfterSway, TheFirstMotionCanBeRecognized) {
    Config config = config_with(1e-6);
    config.quality.longest_ms = 5; // an eighth of the cells takes less, all of them more
    config.memory.mesh_megabytes = 0;
    const double slower = 1;
    Session session(config, large_, *context_);
    session.share_frames(std::make_unique<KnownTimesOfCells>(slower));
    FrameReport report = first_frame(session, false);
    ASSERT_TRUE(test_support::eventually([&] {
        report = at(session, 0);
        return report.volume_cells.value_or(0) > 0 && report.final;
    }));
    const std::uint64_t all = *report.volume_cells;
    report = at(session, 0.3);
    ASSERT_EQ(report.pace, interaction::Pace::moving);
    EXPECT_GT(report.coarsest, 0u);
    EXPECT_GE(report.cells, all / 12) << "of whole levels, so about an eighth";
}

} // namespace
} // namespace isochron::app
