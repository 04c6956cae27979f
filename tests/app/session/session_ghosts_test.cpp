// Surfaces of other steps beside those that are shown: which, made how often, drawn and picked as what
// they are, and the same in every replay.
#include "app/loop/replay.h"
#include "index/extraction/instant_surfaces.h"
#include "tests/app/session/quality_session.h"
#include "tests/support/test_seed.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

using index::Instant;
using interaction::Commands;
using interaction::Ghosts;
using testing::ElementsAre;
using testing::IsEmpty;

Commands asking(const Ghosts& ghosts) {
    Commands commands;
    commands.ghosts = ghosts;
    return commands;
}
Commands at_instant(Instant at) {
    Commands commands;
    commands.instant = at;
    if (at.between())
        commands.between = interaction::BetweenSteps::blend;
    return commands;
}

TEST(GhostInstants, LieWithinTheSeriesAndTheRangeThatPlays) {
    struct Row {
        Ghosts ghosts;
        Instant shown;
        interaction::StepRange range;
        std::vector<Instant> expected; ///< the nearest first
    };
    const auto at = [](std::uint32_t step, std::uint32_t fraction = 0) {
        return Instant(step, fraction);
    };
    const std::vector<Row> rows{
        {{2, 2, 1}, at(5), {}, {at(4), at(6), at(3), at(7)}},
        {{2, 2, 3}, at(5), {}, {at(2), at(8)}},
        {{4, 4, 2}, at(4), {}, {at(2), at(6), at(0), at(8)}},
        {{3, 0, 1}, at(1), {}, {at(0)}},
        {{0, 4, 1}, at(9), {}, {}},
        {{0, 0, 1}, at(5), {}, {}},
        {{.earlier = 2, .later = 2, .opacity = 0}, at(5), {}, {}},
        {{1, 1, 100'000}, at(5), {}, {}},
        {{2, 2, 1}, at(5), {4, 6}, {at(4), at(6)}},
        {{2, 2, 1}, at(5), {6, {}}, {at(6), at(7)}},
        {{2, 2, 1}, at(5), {{}, 3}, {at(3)}},
        {{2, 2, 1}, at(3, 100), {}, {at(2, 100), at(4, 100), at(1, 100), at(5, 100)}},
        {{1, 2, 1}, at(7, 100), {}, {at(6, 100), at(8, 100)}}, // none behind the last step
        {{1, 1, 1}, at(7, 100), {6, 8}, {at(6, 100)}},
        {{0, 1, 1}, at(1, 100), {}, {at(2)}}, // behind step 2 there is a gap: it is held
    };
    const interaction::StepGaps gaps({2}), none;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const bool gap = i + 1 == rows.size();
        EXPECT_EQ(
            ghost_instants(rows[i].ghosts, rows[i].shown, rows[i].range, 10, gap ? gaps : none),
            rows[i].expected)
            << i;
    }
}

TEST(GhostInstants, AreNamedAsPeopleCount) {
    EXPECT_EQ(ghost_words({}), "");
    EXPECT_EQ(ghost_words(std::vector{Instant(2)}), "ghost of step 3");
    EXPECT_EQ(ghost_words(std::vector{Instant(2), Instant(4), Instant(8)}),
              "ghosts of steps 3, 5 and 9");
    EXPECT_EQ(ghost_words(std::vector{Instant(2, 32'768), Instant(3, 32'768)}),
              "ghosts of steps 3.50 and 4.50");
}

class SessionGhosts : public SessionQuality {
  protected:
    static std::vector<Instant> instants(const Session& session) {
        std::vector<Instant> all;
        for (const auto& ghost : session.ghosts().shown())
            all.push_back(ghost->query.instant);
        return all;
    }
    FrameReport frame(Session& session, const Commands& commands, Waiting waiting) {
        return session.frame(head_at_rest(now().count() + frame_++ / kRate), commands, waiting);
    }
    FrameReport frame(Session& session, const Commands& commands = {}) {
        return frame(session, commands, Waiting::for_cells);
    }
    /// Where the sphere of a ghost has its middle along x.
    static double middle_of(const index::InstantSurfaces& ghost) {
        double low = 1e9, high = -1e9;
        for (const index::MeshVertex& vertex : ghost.meshes.at(0)->vertices) {
            low = std::min(low, position_of(vertex).x);
            high = std::max(high, position_of(vertex).x);
        }
        return (low + high) / 2;
    }
    /// Each ghost is a sphere where it was at the ghost's own instant: `MovingSphere` moves by a
    /// vertex a step.
    static void expect_true(const Session& session) {
        for (const auto& ghost : session.ghosts().shown()) {
            const Instant at = ghost->query.instant;
            EXPECT_NEAR(middle_of(*ghost),
                        12.0 + at.step + double(at.fraction) / Instant::kFractions, 0.05);
            EXPECT_NE(at, session.state().shown_instant());
        }
    }
};
INSTANTIATE_TEST_SUITE_P(, SessionGhosts, testing::Values(stereo::ContextKind::egl), context_name);

TEST_P(SessionGhosts, AreMadeOnceWhileTimePlays) {
    Session session(small_config(), file_, *context_); // six steps
    frame(session, at_instant(Instant(2)));
    EXPECT_EQ(session.ghosts().made(), 0u);
    struct Row {
        std::uint32_t step;
        std::uint64_t made; ///< so far
        std::vector<std::uint32_t> shown;
    };
    const std::vector<Row> rows{{2, 4, {0, 1, 3, 4}}, {3, 6, {1, 2, 4, 5}}, {4, 6, {2, 3, 5}},
                                {5, 6, {3, 4}},       {4, 6, {2, 3, 5}},    {2, 6, {0, 1, 3, 4}}};
    frame(session, asking({2, 2, 1}));
    for (const Row& row : rows) {
        frame(session, at_instant(Instant(row.step)));
        std::vector<Instant> expected;
        for (const std::uint32_t step : row.shown)
            expected.emplace_back(step);
        EXPECT_EQ(instants(session), expected) << row.step;
        EXPECT_EQ(session.ghosts().made(), row.made) << row.step;
        EXPECT_FALSE(session.ghosts().come());
        expect_true(session);
    }
    Commands other;
    other.isovalue = 4.5;
    frame(session, other);
    EXPECT_EQ(session.ghosts().made(), 10u) << "another isovalue, other ghosts";
    for (const auto& ghost : session.ghosts().shown())
        EXPECT_EQ(ghost->query.isovalues, std::vector{4.5});
    frame(session, asking({}));
    EXPECT_THAT(instants(session), IsEmpty());
    EXPECT_EQ(session.ghosts().words(), "");
}

TEST_P(SessionGhosts, LieAsFarBetweenStepsAsWhatIsShown) {
    Session session(small_config(), file_, *context_);
    frame(session, asking({1, 1, 2}));
    frame(session, at_instant(Instant(2, 32'768)));
    EXPECT_THAT(instants(session), ElementsAre(Instant(0, 32'768), Instant(4, 32'768)));
    expect_true(session);
    EXPECT_EQ(session.ghosts().words(), "ghosts of steps 1.50 and 5.50");
}

/// A live session shows what is there: never a ghost as another step than it is, nor the shown step.
TEST_P(SessionGhosts, NeverKeepALiveFrameWaitingNorShowAsOtherSteps) {
    Session session(config_with(kPlenty), file_, *context_);
    start(session);
    rest(session, 1, asking({2, 2, 1}));
    std::mt19937 random(test_seed());
    for (int i = 0; i < 60; ++i) {
        rest(session, 1, at_instant(Instant(static_cast<std::uint32_t>(random() % 6))));
        expect_true(session);
        const auto& wished = session.ghosts().wished();
        EXPECT_LE(instants(session).size(), wished.size());
        if (!session.ghosts().come()) {
            EXPECT_EQ(instants(session), wished);
        }
    }
    rest_until(session, [&](const FrameReport&) { return !session.ghosts().come(); });
    EXPECT_EQ(instants(session), session.ghosts().wished());
}

/// Each frame of time that plays between steps has another instant: ghosts of whole steps serve for
/// many of them.
TEST_P(SessionGhosts, AreOfWholeStepsWhileTimePlaysBetweenThem) {
    Session session(config_with(kPlenty), file_, *context_);
    start(session);
    Commands plays = asking({1, 1, 1});
    plays.between = interaction::BetweenSteps::blend;
    plays.playback.emplace().playing = true;
    rest(session, 1, plays);
    for (std::uint32_t i = 0; i < 300; ++i) {
        rest(session, 1, at_instant(Instant(i / 60, i % 60 * 1092)));
        for (const Instant at : instants(session))
            EXPECT_FALSE(at.between());
        expect_true(session);
    }
    EXPECT_LE(session.ghosts().made(), 6u) << "each step once";
    Commands stops;
    stops.playback.emplace();
    rest(session, 1, stops);
    rest_until(session, [&](const FrameReport&) { return !session.ghosts().come(); });
    EXPECT_EQ(instants(session), session.ghosts().wished());
    EXPECT_THAT(instants(session), ElementsAre(Instant(3, 59 * 1092)));
}

TEST_P(SessionGhosts, AreTheSameInEveryReplay) {
    interaction::Recording recording;
    std::vector<std::vector<std::uint8_t>> seen;
    Session first(small_config(), file_, *context_);
    recording.header.start = first.state().as_commands();
    const std::vector<Commands> told{asking({1, 2, 1, 0.5f}), at_instant(Instant(1)),
                                     at_instant(Instant(2)),  at_instant(Instant(3, 20'000)),
                                     asking({0, 0}),          asking({4, 4, 2, 0.3f}),
                                     at_instant(Instant(5))};
    for (const Commands& commands : told) {
        interaction::RecordedFrame one;
        one.input = head_at_rest(0.1 * static_cast<double>(recording.frames.size()));
        one.commands = commands;
        recording.frames.push_back(std::move(one));
    }
    for (int round = 0; round < 2; ++round) {
        Session session(small_config(), file_, *context_);
        std::size_t number = 0;
        replay_fixed_step(session, recording, {}, [&](std::size_t, const auto&) {
            EXPECT_EQ(instants(session), session.ghosts().wished());
            if (round == 0)
                seen.push_back(shown(session));
            else
                EXPECT_EQ(shown(session), seen[number]) << number;
            ++number;
        });
    }
    EXPECT_NE(seen[4], seen[5]) << "ghosts are seen";
}

/// Earlier ghosts are bluer than their surface, later ones warmer, on the sides where they were and
/// where they will be.
TEST_P(SessionGhosts, AreSeenWhereTheSurfaceWasAndWhereItGoes) {
    Config config = small_config(stereo::StereoMode::mono);
    config.start.bounding_box = false;
    Session session(config, file_, *context_);
    const auto picture = [&](const Commands& commands) {
        frame(session, commands);
        frame(session);
        return session.outputs().display().read_window();
    };
    Commands there = at_instant(Instant(3));
    there.isovalue = 9.0;
    there.quality = interaction::QualityMode::quality; // one footprint for all pictures
    const render::Image alone = picture(there);
    const auto changed = [&](const render::Image& image, const auto& counts) {
        glm::dvec3 sum(0.0);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width * 3 / 4; ++x) { // the legend is beside them
                const auto *a = alone.at(x, y), *b = image.at(x, y);
                if (a[0] != b[0] || a[1] != b[1] || a[2] != b[2])
                    if (counts(x))
                        sum += glm::dvec3(b[0], b[1], b[2]) - glm::dvec3(a[0], a[1], a[2]);
            }
        return sum;
    };
    const int middle = alone.width / 2;
    const auto left = [&](int x) { return x < middle; };
    const auto right = [&](int x) { return x >= middle; };
    const render::Image earlier = picture(asking({2, 0, 1, 0.6f}));
    EXPECT_GT(changed(earlier, left).z, 1.5 * changed(earlier, left).x) << "blue";
    EXPECT_GT(changed(earlier, left).z, 1000);
    const render::Image later = picture(asking({0, 2, 1, 0.6f}));
    EXPECT_GT(changed(later, right).x, 1000);
    EXPECT_GT(changed(later, right).x, 1.5 * changed(later, right).z) << "warm";
    EXPECT_GT(changed(earlier, left).z, changed(later, left).z);
    EXPECT_GT(changed(later, right).x, changed(earlier, right).x);
    const render::Image again = picture(asking({0, 0}));
    EXPECT_EQ(again.rgba, alone.rgba);
}

TEST_P(SessionGhosts, ArePickedAsTheStepThatTheyAreOf) {
    Picker picker(file_);
    ExplorerState state;
    state.isosurfaces = {{.isovalue = 6.0}}; // a radius of 10
    const auto ghost = [&](std::uint32_t step) {
        return index::instant_surfaces(file_, {Instant(step), {6.0}}, 1 << 20);
    };
    picker.set_ghosts({ghost(0), ghost(5)});
    const auto hit = [&](bool from_left) {
        // Along x, through the middle of the spheres.
        const float turn = (from_left ? -0.5f : 0.5f) * std::numbers::pi_v<float>;
        const interaction::Pose ray{{from_left ? -5.0f : 40.0f, 15.5f, 15.5f},
                                    glm::angleAxis(turn, glm::vec3(0, 1, 0))};
        return picker.hit_by(ray, state, nullptr);
    };
    ASSERT_TRUE(hit(true) && hit(false));
    EXPECT_EQ(hit(true)->point.instant, Instant(0));
    EXPECT_NEAR(hit(true)->point.position.x, 2.0, 0.1);
    EXPECT_EQ(hit(false)->point.instant, Instant(5));
    EXPECT_NEAR(hit(false)->point.position.x, 27.0, 0.1);
    EXPECT_EQ(hit(false)->point.value, 6.0);
    state.clip = {.shown = true, .point = {14, 0, 0}, .normal = {1, 0, 0}};
    EXPECT_NEAR(hit(false)->point.position.x, 7.0, 0.1) << "the far side of the later one";
    state.clip.shown = false;
    state.isosurfaces[0].opacity = 0;
    EXPECT_FALSE(hit(true)) << "what is hidden has no ghosts";
}

} // namespace
} // namespace isochron::app
