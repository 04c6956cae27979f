// Warming up: what cells are drawn with has been used before the first frame.
#include "tests/support/drawing/compilations.h"
#include "tests/support/drawing/context_in_between.h"
#include "tests/support/eventually.h"
#include "tests/support/session_fixture.h"

#include "app/end_in_time.h"
#include "render/gl/shader.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <memory>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include <unistd.h>

namespace isochron::app {
namespace {

struct {
    std::set<GLuint> used;
    PFNGLUSEPROGRAMPROC use = nullptr;
    bool hang = false; ///< a signal comes, and the driver does not return
} programs;

void APIENTRY noted_program(GLuint program) {
    if (programs.hang) {
        EndInTime::signaled(SIGTERM);
        for (;;)
            pause();
    }
    programs.used.insert(program);
    programs.use(program);
}
void* with_noted_programs(std::string_view name, void* found) {
    return name == "glUseProgram" ? stereo::before(found, programs.use, &noted_program) : found;
}

class WarmUp : public SessionTest {
  protected:
    stereo::ContextInBetween noting_{GetParam(), {256, 128}, with_noted_programs};
};

INSTANTIATE_TEST_SUITE_P(, WarmUp,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

TEST_P(WarmUp, UsesEveryProgramThatCellsNeedFromFarAndFromWithin) {
    const auto expect_warm = [&](render::Footprint settled, float opacity) {
        SCOPED_TRACE(testing::Message() << render::name_of(settled) << ", opacity " << opacity);
        Config config = small_config();
        config.quality.settled = settled;
        config.quality.frame_budget_ms = 1e-6; // quads in motion
        config.quality.still_budget_ms = 0;    // no parts
        if (settled == render::Footprint::mesh)
            config.rendering.drawn_by = render::DrawnBy::processor; // else there are no meshes
        programs.used.clear();
        Session session(config, file_, noting_);
        session.warm_up();
        EXPECT_TRUE(session.log().frames().empty()) << "nobody sees it";
        const std::set<GLuint> warm = programs.used;
        int number = 0;
        const auto is_drawn = [&](render::Footprint footprint, float way, bool moves) {
            return test_support::eventually([&] {
                bool drawn = false;
                for (int i = 0; i < 30; ++i) {
                    interaction::InputState input = head_at_rest(number++ / 60.0);
                    input.devices[0].pose->position.z = -way - (moves && i % 2 ? 0.02f : 0.0f);
                    interaction::Commands commands;
                    if (number == 1)
                        commands.isosurfaces = {{{2.0, {0.9f, 0.3f, 0.2f}, opacity}}};
                    const FrameReport& report = session.frame(input, commands, Waiting::never);
                    // Triangles are taken in motion where quads take about as long.
                    drawn |= report.redrawn && report.cells > 0 &&
                             (report.footprint == footprint ||
                              (moves && report.footprint == render::Footprint::mesh));
                }
                return drawn;
            });
        };
        for (const float way : {0.0f, 0.7f, 3.0f}) { // ahead is the volume
            // The head moves until cells are there, however late they come.
            ASSERT_TRUE(is_drawn(render::Footprint::quad, way, true));
            ASSERT_TRUE(is_drawn(settled, way, false));
        }
        for (const GLuint program : programs.used)
            EXPECT_TRUE(warm.contains(program)) << program;
        EXPECT_GT(warm.size(), 4u);
    };
    expect_warm(render::Footprint::gaussian, 1.0f);
    expect_warm(render::Footprint::mesh, 1.0f);
    expect_warm(render::Footprint::mesh, 0.4f);
    expect_warm(render::Footprint::surface, 1.0f);
    expect_warm(render::Footprint::surface, 0.4f);
}

TEST_P(WarmUp, LooksAtTheUserAfterEveryFewDrawsAndEndsWhenAsked) {
    Session session(small_config(), file_, noting_);
    std::vector<float> shares;
    std::vector<std::size_t> begun; // programs whose first use falls between two looks
    programs.used.clear();
    std::size_t before = 0;
    session.warm_up([&](float share) {
        shares.push_back(share);
        begun.push_back(programs.used.size() - std::exchange(before, programs.used.size()));
        return true;
    });
    EXPECT_GE(shares.size(), 15u);
    EXPECT_TRUE(std::ranges::is_sorted(shares));
    EXPECT_EQ(shares.front(), 0);
    begun.erase(begun.begin(), begun.begin() + 2); // what stands beside the cells, and what moves
    EXPECT_LE(std::ranges::max(begun), 4u);
    std::size_t looks = 0;
    session.warm_up([&](float) { return ++looks < 3; });
    EXPECT_EQ(looks, 3u);
}

/// What is prepared between frames may make a driver compile for seconds: nobody waits for it.
TEST_P(WarmUp, ASignalEndsASessionThatPreparesBetweenFramesAndSavesIt) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(
        {
            EndInTime::allow("lab");
            EndInTime::watch();
            Session session(small_config(), file_, noting_);
            session.prepare_first([](float) { return true; }, nullptr);
            const SavedAtEnd saving([] { std::fputs("saved, ", stderr); });
            programs.hang = true;
            while (session.prepare_some()) {
            }
        },
        testing::ExitedWithCode(128 + SIGTERM), "saved, lab: canceled");
}

/// Whatever a user does after the first picture, no frame links a program: it shows what is ready, and
/// the rest is linked between frames.
TEST_P(WarmUp, TheFirstPictureLinksADozenProgramsAndNoLaterFrameLinksAny) {
    struct Row {
        const char* what;
        float opacity;
        bool by_value;
        bool beside; ///< another thread draws ahead
    };
    for (const Row& row :
         {Row{"opaque", 1.0f, false, true}, Row{"translucent", 0.5f, false, false},
          Row{"colored", 1.0f, true, false}, Row{"colored and translucent", 0.5f, true, true}}) {
        SCOPED_TRACE(row.what);
        Config config = small_config();
        config.quality.settled = render::Footprint::surface;
        const std::size_t none = render::linked_programs();
        Session session(config, file_, noting_);
        ExplorerState start = session.state();
        start.isosurfaces = {{2.0, {0.9f, 0.3f, 0.2f}, row.opacity}};
        if (row.by_value)
            start.coloring.by = interaction::ColorBy::first_crossing;
        session.set_state(start);
        std::unique_ptr<stereo::GlContext> beside;
        const bool crashes = noting_.description().find("zink") != std::string::npos;
        if (row.beside && GetParam() == stereo::ContextKind::egl && !crashes) {
            beside = stereo::make_context(GetParam(), {.size = {1, 1}});
            beside->leave();
            noting_.make_current();
        }
        std::size_t looks = 0;
        session.prepare_first([&](float) { return ++looks > 0; }, std::move(beside));
        EXPECT_GE(looks, 2u);
        int number = 0;
        const auto frame = [&](const interaction::Commands& commands, float way) {
            interaction::InputState input = head_at_rest(number++ / 60.0);
            input.devices[0].pose->position.z = -way;
            return session.frame(input, commands, Waiting::never);
        };
        ASSERT_TRUE(test_support::eventually([&] { return frame({}, 0).final; }));
        const std::size_t first = render::linked_programs() - none;
        std::printf("%s: %zu programs before the first picture\n", row.what, first);
        EXPECT_LE(first, 17u);
        std::size_t between = 0, in_frames = 0;
        const auto watched = [&](const interaction::Commands& commands, float way) {
            const std::size_t before = render::linked_programs();
            const bool final = frame(commands, way).final;
            in_frames += render::linked_programs() - before;
            return final;
        };
        const auto wander = [&](int to) { // what leads to other programs, again and again
            interaction::Commands commands;
            commands.isosurfaces = {{{2.0, {0.9f, 0.3f, 0.2f}, to % 2 ? 0.4f : 1.0f}}};
            commands.coloring.emplace().by =
                to / 2 % 2 ? interaction::ColorBy::first_crossing : interaction::ColorBy::surface;
            for (const float way : {0.7f, 0.02f, 0.7f, 3.0f, 0.0f})
                watched(std::exchange(commands, {}), way);
        };
        for (int to = 0; to < 4; ++to)
            wander(to);
        EXPECT_EQ(in_frames, 0u) << "before any other program is ready";
        int looked = 0;
        ASSERT_TRUE(test_support::eventually([&] {
            const std::size_t before = render::linked_programs();
            session.prepare_some();
            between += render::linked_programs() - before;
            wander(looked++);
            return !session.prepares();
        }));
        EXPECT_GE(between, 10u);
        EXPECT_EQ(in_frames, 0u);
        EXPECT_TRUE(test_support::eventually([&] { return watched({}, 0.0f); }));
        EXPECT_EQ(in_frames, 0u) << "the exact picture, once all are ready";
    }
}

TEST_P(WarmUp, CellsOfAnyNumberAndColorNeedNothingCompiled) {
    // Others compile where nobody can count it; zink, by Vulkan on the same llvmpipe, for itself.
    const std::string driver = noting_.description();
    const bool counted =
        driver.find("llvmpipe") != std::string::npos && driver.find("zink") == std::string::npos;
    MovingSphere series(6, 33); // unlike the small surface of the warm-up, of no power of two
    build_index(series, folder_.path() / "odd.isochron", {});
    const auto file = index::IndexFile::open(folder_.path() / "odd.isochron");
    const auto compiled_after_warm_up = [&](render::Footprint settled) {
        Config config = small_config();
        config.quality.settled = settled;
        config.quality.frame_budget_ms = 1e-6; // quads in motion
        config.quality.still_budget_ms = 0;    // no parts
        config.rendering.drawn_by = render::DrawnBy::processor;
        Session session(config, file, noting_);
        session.warm_up();
        const int warm = test_support::compilations();
        EXPECT_TRUE(warm > 0 || !counted);
        int number = 0;
        const auto expect_shown = [&](interaction::Commands commands) {
            EXPECT_TRUE(test_support::eventually([&] {
                const FrameReport& report = session.frame(
                    head_at_rest(number++ / 60.0), std::exchange(commands, {}), Waiting::never);
                return report.redrawn && report.cells > 0 && report.footprint == settled &&
                       report.shown == report.asked;
            }));
        };
        interaction::Commands commands;
        for (const double isovalue : {2.0, 3.0, 8.5, 15.2}) { // thousands of cells to eight
            commands.isosurfaces = {{{isovalue, {0.9f, 0.3f, 0.2f}, 1.0f}}};
            expect_shown(commands);
        }
        commands.coloring.emplace().by = interaction::ColorBy::first_crossing;
        commands.instant = index::Instant(2); // a new set, with its colors
        expect_shown(commands);
        commands.coloring->bands = 5;
        commands.instant = index::Instant(3);
        expect_shown(commands);
        return counted ? test_support::compilations() - warm : 0;
    };
    compiled_after_warm_up(render::Footprint::gaussian); // what is not of cells is kept for later
    for (const render::Footprint footprint :
         {render::Footprint::gaussian, render::Footprint::mesh, render::Footprint::surface})
        EXPECT_EQ(compiled_after_warm_up(footprint), 0) << render::name_of(footprint);
}

} // namespace
} // namespace isochron::app
