// Levels of detail in a session: what moves or sways is shown a set that fits, what rests all cells.
#include "tests/support/eventually.h"
#include "tests/support/memory_series.h"
#include "tests/support/session_fixture.h"

#include <cmath>

namespace isochron::app {
namespace {

class SessionDetail : public SessionTest {
  protected:
    SessionDetail()
        : waves_({97, 97, 97}, 1, index::ValueType::f32, [](double x, double y, double z, double) {
              return std::sin(x / 3) + std::sin(y / 3) + std::sin(z / 3);
          }) {
        index::MemorySeries series(waves_.view());
        build_index(series, folder_.path() / "waves.isochron", {});
        large_ = index::IndexFile::open(folder_.path() / "waves.isochron");
    }
    static Config config_with(double budget_ms) {
        Config config = small_config();
        config.frame_budget_ms = budget_ms;
        config.still_budget_ms = 10'000;
        return config;
    }
    /// A head at rest, or one that sways too slowly to be moving.
    FrameReport frame(Session& session, bool sways, const interaction::Commands& commands = {}) {
        interaction::InputState input = head_at_rest(frame_ / 60.0);
        if (sways)
            input.devices[0].pose->position.x = 1e-5f * static_cast<float>(frame_ / 2 % 2);
        ++frame_;
        return session.frame(input, commands, Waiting::never);
    }

    index::TestField waves_;
    std::shared_ptr<const index::IndexFile> large_;
    int frame_ = 0;
};

TEST_P(SessionDetail, AHeadThatSwaysIsShownTheSetForMotionAndOneAtRestAllCells) {
    Session session(config_with(1e-6), large_, *context_); // no number of cells fits
    interaction::Commands first;
    first.isovalue = 0.1;
    FrameReport report = frame(session, true, first);
    ASSERT_TRUE(test_support::eventually([&] {
        report = frame(session, true);
        return report.coarsest > 0 && report.pace == interaction::Pace::settled &&
               report.cells <= 2 * DetailChoice::kFewest; // once a time has been measured
    }));
    for (int i = 0; i < 60; ++i) {
        report = frame(session, true);
        ASSERT_LE(report.cells, 2 * DetailChoice::kFewest) << i;
    }
    ASSERT_TRUE(test_support::eventually([&] {
        report = frame(session, false);
        return report.coarsest == 0;
    }));
    const std::uint64_t all = report.cells;
    EXPECT_GT(all, 3 * DetailChoice::kFewest);
    EXPECT_EQ(report.volume_cells, all);
    for (int i = 0; i < 20; ++i)
        EXPECT_EQ(frame(session, false).cells, all);
    for (int i = 0; i < 3; ++i)
        report = frame(session, true); // by the last one the head has moved
    EXPECT_GT(report.coarsest, 0u) << "in the frame in which it moves";
    EXPECT_LE(report.cells, 2 * DetailChoice::kFewest);
    EXPECT_EQ(report.volume_cells, all) << "it is known";
}

INSTANTIATE_TEST_SUITE_P(Contexts, SessionDetail,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

} // namespace
} // namespace isochron::app
