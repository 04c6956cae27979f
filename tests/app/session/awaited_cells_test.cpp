// Isovalues that are asked for: what is shown until their cells are found, and how soon these are.
#include "tests/app/session/quality_session.h"
#include "tests/support/gate.h"
#include "tests/support/thread_rest.h"

#include <unistd.h>

namespace isochron::app {
namespace {

using interaction::Commands;
using render::Footprint;

class AwaitedCells : public SessionQuality {
  protected:
    /// The real extraction, which finds nothing but these isovalues until the gate is open.
    index::Extract held_but_for(double isovalue) {
        return [this, isovalue, real = index::extract_from(file_)](
                   const index::SurfacesQuery& query, std::stop_token stop) {
            if (query.isovalues.front() != isovalue)
                gate_.pass(stop);
            return real(query, std::move(stop));
        };
    }
    static Commands asking_for(double isovalue) {
        Commands commands;
        commands.isovalue = isovalue;
        return commands;
    }
    FrameReport with_head(Session& session, float aside) {
        interaction::InputState input = head_at_rest(now().count());
        ++frame_;
        input.devices[0].pose->position.x += aside;
        return session.frame(input, {}, Waiting::never);
    }
    test_support::Gate gate_;
};
INSTANTIATE_TEST_SUITE_P(Contexts, AwaitedCells,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

TEST_P(AwaitedCells, LeaveTheLastPictureAsItIsUntilTheyCome) {
    constexpr double kFirst = 4, kOther = 6;
    const Config config = config_in_parts();
    Session session(config, file_, *context_, held_but_for(kFirst));
    session.frame(head_at_rest(0), asking_for(kFirst), Waiting::for_cells);
    rest_until(session, is_exact);
    const auto before = shown(session);
    for (int i = 0; i < 40; ++i) {
        const double dragged = kOther + 0.01 * std::min(i - 20, 0);
        const FrameReport report = rest(session, 1, asking_for(dragged));
        EXPECT_FALSE(report.redrawn) << i;
        EXPECT_EQ(report.footprint, Footprint::surface) << i;
        EXPECT_FALSE(report.final) << i;
    }
    EXPECT_TRUE(shown(session) == before);
    gate_.open();
    const FrameReport last = rest_until(session, is_exact);
    EXPECT_EQ(last.shown, last.asked);
    Session other(config, file_, *context_);
    other.frame(head_at_rest(0), asking_for(kOther), Waiting::for_cells);
    rest_until(other, is_exact);
    EXPECT_TRUE(shown(session) == shown(other)) << "to the bit, legend and all";
}

TEST_P(AwaitedCells, DoNotKeepOtherChangesFromTheEyes) {
    constexpr double kFirst = 4;
    Session session(config_in_parts(), file_, *context_, held_but_for(kFirst));
    session.frame(head_at_rest(0), asking_for(kFirst), Waiting::for_cells);
    rest_until(session, is_exact);
    EXPECT_FALSE(rest(session, 1, asking_for(6)).redrawn);
    EXPECT_TRUE(with_head(session, 0.3f).redrawn);
    EXPECT_TRUE(with_head(session, 0.6f).redrawn);
    Commands color;
    color.isosurfaces = session.state().isosurfaces;
    color.isosurfaces->front().color = {0.1f, 0.9f, 0.2f};
    EXPECT_TRUE(rest(session, 1, color).redrawn);
    gate_.open();
}

} // namespace
} // namespace isochron::app
