// The states of quality: what leads to them, what sessions make of them, and what ARCHITECTURE says.
#include "app/quality/picture_state.h"
#include "tests/app/frame/simulated_session.h"
#include "tests/support/paths.h"
#include "tests/support/test_seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

using render::Footprint;

std::vector<PictureState> all_states() {
    std::vector<PictureState> states;
    for (std::size_t shown = 0; shown < kShown; ++shown)
        for (std::size_t beside = 0; beside < kBeside; ++beside)
            for (const bool whole : {false, true})
                if (const auto state =
                        PictureState::of(static_cast<Shown>(shown), static_cast<Beside>(beside),
                                         Footprint::surface, whole))
                    states.push_back(*state);
    return states;
}

TEST(PictureState, IsLegalWhateverIsDoneToIt) {
    const std::vector<std::function<void(PictureState&)>> changes{
        [](PictureState& state) { state.improve(); },
        [](PictureState& state) { state.stand_in(); },
        [](PictureState& state) { state.make_parts(Footprint::surface); },
        [](PictureState& state) { state.share_parts(true); },
        [](PictureState& state) { state.give_up_parts(); },
        [](PictureState& state) { state.draw_ahead(true); },
        [](PictureState& state) { state.draw_ahead(false); },
        [](PictureState& state) { state.move(); },
        [](PictureState& state) { state.hold(); }};
    for (const PictureState& before : all_states())
        for (std::size_t i = 0; i < changes.size(); ++i) {
            PictureState after = before;
            changes[i](after);
            EXPECT_TRUE(PictureState::is_legal(after.shown(), after.beside()))
                << name_of(before.shown()) << " beside " << name_of(before.beside()) << ", change "
                << i;
            EXPECT_FALSE(after.is_final() && (after.is_trial() || after.in_parts()));
            EXPECT_TRUE(after.in_parts() || !after.parts_are_whole());
        }
}

TEST(PictureState, HasTheRowsOfItsTableInArchitecture) {
    std::set<std::string> said, expected;
    std::ifstream page(test_support::source_root() + "/docs/ARCHITECTURE.md");
    bool here = false;
    for (std::string line; std::getline(page, line);) {
        here = line.starts_with("## ") ? line == "## The states of quality" : here;
        if (!here || !line.starts_with("| `"))
            continue;
        std::vector<std::string> cells;
        for (std::size_t at = 0; at != std::string::npos && at + 1 < line.size();) {
            const std::size_t next = line.find(" |", at + 1);
            cells.push_back(line.substr(at + 2, next - at - 2));
            at = next == std::string::npos ? next : next + 1;
        }
        ASSERT_GE(cells.size(), 4u) << line;
        said.insert(cells[0] + " " + cells[2] + " " + cells[3]);
    }
    for (std::size_t i = 0; i < kShown; ++i) {
        std::string beside;
        bool final = false;
        for (std::size_t j = 0; j < kBeside; ++j)
            if (const auto state = PictureState::of(static_cast<Shown>(i), static_cast<Beside>(j),
                                                    Footprint::surface, false)) {
                beside +=
                    fmt::format("{}`{}`", beside.empty() ? "" : ", ", name_of(state->beside()));
                final = state->is_final();
            }
        expected.insert(fmt::format("`{}` {} {}", name_of(static_cast<Shown>(i)),
                                    final ? "yes" : "no", beside));
    }
    EXPECT_EQ(said, expected);
}

TEST(PictureState, IsNotFinalWhereABetterPictureComesHoweverLongTheSessionHasWaited) {
    constexpr interaction::Seconds kAnHour{3600};
    int come = 0;
    for (std::uint32_t seed = 1; seed <= 50; ++seed) {
        SimulatedSession session(seed);
        session.rest_and_sway(kAnHour);
        const FramePlan plan = session.frame().plan;
        come += plan.finer_in_parts;
        EXPECT_FALSE(plan.finer_in_parts && plan.state.is_final()) << "seed " << seed;
    }
    EXPECT_GT(come, 5);
}

TEST(PictureState, AutoDrawsCellsThatHaveNoSurfaceWithoutSplats) {
    const render::Gl gl = gl_without_clock();
    for (const auto mode : {interaction::QualityMode::automatic, interaction::QualityMode::paper}) {
        FrameQuality quality(gl, Config(), 60);
        ExplorerState state;
        state.quality = mode;
        int splats = 0, rests = 0;
        for (int i = 0; i < 300; ++i) {
            const bool moves = i % 100 < 20;
            FrameReport report;
            report.time = interaction::Seconds(i / 60.0);
            report.pace = moves ? interaction::Pace::moving : interaction::Pace::settled;
            report.cells = 50'000;
            report.asked = {index::Instant(0), {1.0}};
            report.shown = report.asked;
            quality.charge({1, 2e5}, state.isosurfaces);
            const auto coarse = render::FootprintSet::up_to(render::Footprint::gaussian);
            const FramePlan plan =
                quality.choose(state, moves, Choosing::with_parts, coarse, coarse, report);
            std::vector<DrawSample> samples(1);
            samples[0].footprint = plan.footprint;
            samples[0].load = {5e4, 2e5};
            samples[0].processor = Milliseconds(2);
            quality.learn(samples);
            splats += plan.footprint == render::Footprint::gaussian ||
                      plan.state.in_parts() == render::Footprint::gaussian;
            rests += plan.state.is_final();
        }
        EXPECT_GT(rests, 100);
        EXPECT_EQ(splats > 0, mode == interaction::QualityMode::paper);
    }
}

TEST(PictureState, PassesOverTranslucentSurfacesCountBeforeAnyOfThemIsMeasured) {
    const render::Gl gl = gl_without_clock();
    // Opacities of the surfaces, and the passes that they take: a hidden surface takes none.
    const std::vector<std::pair<std::vector<float>, double>> all{{{1}, 1},
                                                                 {{0.5f}, 1},
                                                                 {{1, 1, 1}, 1},
                                                                 {{1, 0.5f}, 2},
                                                                 {{0.3f, 0.5f, 0.7f}, 3},
                                                                 {{0, 1}, 1},
                                                                 {{1, 0, 0.5f, 0.5f, 1}, 3}};
    for (const auto& [opacities, passes] : all) {
        FrameQuality quality(gl, Config(), 60);
        FrameLog log;
        ExplorerState state;
        const auto frame = [&](int number, double cells, double passes_now) {
            FrameReport report;
            report.time = interaction::Seconds(number / 60.0);
            report.pace = interaction::Pace::moving;
            report.cells = static_cast<std::uint64_t>(cells);
            quality.learn(quality.collect(log));
            quality.charge({1, 2e5}, state.isosurfaces);
            const auto quads = render::FootprintSet::up_to(render::Footprint::quad);
            quality.choose(state, true, Choosing::with_parts, quads, quads, report);
            quality.begin(static_cast<std::uint64_t>(number));
            quality.end(report, {1, 2e5}, Milliseconds(1 + cells * passes_now * 1e-4));
            return report;
        };
        state.isosurfaces.assign(1, {});
        int number = 0;
        for (; number < 200; ++number)
            frame(number, 1e4 * (number % 5), 1);
        state.isosurfaces.clear();
        for (const float opacity : opacities)
            state.isosurfaces.push_back({.opacity = opacity});
        const FrameReport first = frame(number, 3e4, passes);
        ASSERT_TRUE(first.expected);
        EXPECT_NEAR(first.expected->count(), 1 + 3 * passes, 0.1 * (1 + 3 * passes));
        // What these frames take is charged to as much work as they did.
        for (int i = 1; i < 50; ++i)
            frame(number + i, 1e4 * (i % 5), passes);
        state.isosurfaces.assign(1, {});
        EXPECT_NEAR(frame(number + 50, 3e4, 1).expected->count(), 4, 0.4);
    }
}

/// What the states of a session's frames have in common, whatever happens in it.
TEST(PictureState, OfSimulatedSessionsFollowFromWhatTheEyesSee) {
    std::set<std::string> seen;
    const std::uint32_t first = test_seed();
    for (std::uint32_t seed = first; seed < first + 50; ++seed) {
        SimulatedSession session(seed);
        interaction::Seconds changed_at{0};
        SimulatedSession::Frame before = session.frame();
        for (int i = 1; i < tries(1200); ++i) {
            const SimulatedSession::Frame now = session.frame();
            const PictureState &state = now.plan.state, &last = before.plan.state;
            SCOPED_TRACE(testing::Message() << "session " << seed << ", frame " << i);
            if (now.changed)
                changed_at = now.report.time;
            const bool still = now.report.time - changed_at >= FrameQuality::kStillAfter;
            seen.insert(std::string(name_of(state.shown())) + " " + name_of(state.beside()));
            ASSERT_FALSE(state.is_moved() || state.is_held()) << "that is for others to decide";
            if (state.in_parts()) {
                ASSERT_TRUE(still) << "parts are for what stands";
                ASSERT_TRUE(now.plan.finer_in_parts);
                ASSERT_NE(state.in_parts(), now.plan.footprint) << "it is drawn at once";
            }
            if (state.draws_ahead())
                ASSERT_FALSE(still) << "ahead is for a head that sways";
            if (now.plan.reason == QualityReason::moving)
                ASSERT_EQ(state.shown(), Shown::moving) << "motion is neither final nor measured";
            if (last.in_parts() && state.in_parts() && !now.changed)
                ASSERT_EQ(now.plan.footprint, before.plan.footprint) << "it stays beside parts";
            if (state.is_trial())
                ASSERT_EQ(now.plan.resolution, 0u) << "all pixels tell the cost";
            before = now;
        }
    }
    const std::set<std::string> all{"moving nothing", "moving ahead",    "moving parts",
                                    "trial nothing",  "resting nothing", "resting ahead"};
    EXPECT_TRUE(std::ranges::includes(seen, all)) << "a trial beside a picture ahead is rare";
}

} // namespace
} // namespace isochron::app
