// Levels of detail in a session: what moves or sways is shown a set that fits, what rests all
// cells.
#include "tests/support/context_in_between.h"
#include "tests/support/eventually.h"
#include "tests/support/memory_series.h"
#include "tests/support/session_fixture.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

namespace isochron::app {
namespace {

/// A driver with little room: that many texels in a buffer, and bytes in one allocation.
struct {
    GLint texels = std::numeric_limits<GLint>::max();
    GLsizeiptr bytes = std::numeric_limits<GLsizeiptr>::max();
    bool ran_out = false;
    PFNGLGETINTEGERVPROC integer = nullptr;
    PFNGLNAMEDBUFFERDATAPROC data = nullptr;
    PFNGLGETERRORPROC error = nullptr;
} little;

void APIENTRY little_integer(GLenum name, GLint* value) {
    little.integer(name, value);
    if (name == GL_MAX_TEXTURE_BUFFER_SIZE)
        *value = std::min(*value, little.texels);
}
void APIENTRY little_data(GLuint buffer, GLsizeiptr bytes, const void* data, GLenum usage) {
    if (bytes > little.bytes)
        little.ran_out = true;
    else
        little.data(buffer, bytes, data, usage);
}
GLenum APIENTRY little_error() {
    return std::exchange(little.ran_out, false) ? GL_OUT_OF_MEMORY : little.error();
}
void* with_little_room(std::string_view name, void* found) {
    if (name == "glGetIntegerv")
        return stereo::before(found, little.integer, &little_integer);
    if (name == "glNamedBufferData")
        return stereo::before(found, little.data, &little_data);
    if (name == "glGetError")
        return stereo::before(found, little.error, &little_error);
    return found;
}

constexpr std::uint64_t kFew = 1 << 14; ///< cells: less than a third of those of `large_`

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
               report.cells <= 2 * kFew; // once a time has been measured
    }));
    for (int i = 0; i < 60; ++i) {
        report = frame(session, true);
        ASSERT_LE(report.cells, 2 * kFew) << i;
    }
    ASSERT_TRUE(test_support::eventually([&] {
        report = frame(session, false);
        if (report.redrawn && report.coarsest == 0) {
            EXPECT_EQ(report.reason, QualityReason::in_slices) << "no frame holds all cells";
            EXPECT_NE(report.footprint, render::Footprint::quad);
        }
        return report.coarsest == 0 && report.final;
    }));
    const std::uint64_t all = report.cells;
    EXPECT_GT(all, 3 * kFew);
    EXPECT_EQ(report.volume_cells, all);
    for (int i = 0; i < 20; ++i)
        EXPECT_EQ(frame(session, false).cells, all);
    for (int i = 0; i < 3; ++i)
        report = frame(session, true); // by the last one the head has moved
    EXPECT_GT(report.coarsest, 0u) << "in the frame in which it moves";
    EXPECT_LE(report.cells, 2 * kFew);
    EXPECT_EQ(report.volume_cells, all) << "it is known";
}

TEST_P(SessionDetail, SlicesBeginAnewWhereAFinerSetComes) {
    Config config = config_with(1e-6);
    config.still_budget_ms = 1e-6; // a piece in each frame
    const render::Gl gl(context_->loader());
    const auto second_picture = [&](bool in_the_midst) {
        std::atomic<bool> wait = true, found = false;
        const index::Extract real =
            index::extract_from(large_, std::nullopt, render::CellBuffers::wanted_shading(gl));
        const index::Extract extract = [&](const index::SurfacesQuery& query,
                                           std::stop_token stop) -> index::ExtractionPtr {
            while (query.detail.at_rest && wait && !stop.stop_requested())
                std::this_thread::yield();
            if (!query.detail.at_rest)
                return real(query, stop);
            index::SurfacesQuery same = query; // whatever was measured
            same.detail = {20'000, true, {}};
            const index::ExtractionPtr set = real(same, stop);
            if (!set)
                return nullptr;
            auto asked = std::make_shared<index::Extraction>(*set);
            asked->query = query;
            found = true;
            return asked;
        };
        Session session(config, large_, *context_, extract);
        interaction::Commands first;
        first.isovalue = 0.1;
        FrameReport report = frame(session, false, first);
        const auto made = [&] {
            return report.in_slices && report.cells > 0 && report.footprint == *report.in_slices;
        };
        EXPECT_TRUE(test_support::eventually([&] {
            report = frame(session, false);
            return in_the_midst ? report.in_slices && !made() : made();
        }));
        for (int i = 0; i < 12; ++i) // until some cells are drawn, and not only put in order
            report = frame(session, false);
        EXPECT_NE(made(), in_the_midst);
        const std::uint64_t cells = report.cells;
        wait = false;
        EXPECT_TRUE(test_support::eventually([&] { return found.load(); }));
        EXPECT_TRUE(test_support::eventually([&] {
            report = frame(session, false);
            return report.cells != cells && made();
        }));
        return session.outputs().display().read_window().rgba;
    };
    EXPECT_TRUE(second_picture(true) == second_picture(false));
}

TEST_P(SessionDetail, APictureAtRestGetsAllCellsThoughNoPauseHoldsThemAndSomeOfThemSoon) {
    Config config = config_with(1e-6);
    config.still_budget_ms = 2;
    Session session(config, large_, *context_);
    interaction::Commands first;
    first.isovalue = 0.1;
    FrameReport report = frame(session, false, first);
    for (int rest = 0; rest < 2; ++rest) {
        SCOPED_TRACE(rest);
        std::uint64_t most = 0; // cells of pictures that came before
        int coarse = 0;
        ASSERT_TRUE(test_support::eventually([&] {
            const auto ends = [&] { return report.final && report.cells > 0; };
            for (int i = 0; i < 50 && !ends(); ++i) { // the worker may take its time
                report = frame(session, false);
                if (!report.redrawn || report.reason != QualityReason::in_slices)
                    continue;
                EXPECT_GE(report.cells, most) << "it only gets better";
                most = report.cells;
                coarse += report.coarsest > 0;
            }
            return ends();
        }));
        EXPECT_EQ(report.coarsest, 0u);
        EXPECT_GT(report.cells, 3 * kFew);
        EXPECT_EQ(report.footprint, render::Footprint::surface);
        EXPECT_GT(coarse, 0) << "all cells take long";
        for (int i = 0; i < 3; ++i)
            report = frame(session, true);
        EXPECT_GT(report.coarsest, 0u);
    }
}

/// Frames of a session in which quads take a known time for each cell, or suddenly much longer.
class KnownTimes final : public FramesAlone {
  public:
    explicit KnownTimes(const bool& stalls) : stalls_(stalls) {}
    std::vector<DrawSample> samples(std::vector<DrawSample>) override {
        constexpr double kOfCell = 1.5 / 20'000 / 2; // ms, in two views
        const double slower = stalls_ ? 1000 : 1;
        std::vector<DrawSample> all(1);
        all[0].load = {2e4, 1 << 15};
        all[0].processor = Milliseconds(slower * kOfCell * all[0].load.cells);
        return all;
    }

  private:
    const bool& stalls_;
};

TEST_P(SessionDetail, ATimeThatStallsTakesNoCellsFromAPictureAtRest) {
    Config config = config_with(1e-6);
    config.still_budget_ms = 2; // three quarters of it hold 20,000 cells
    bool stalls = false;
    Session session(config, large_, *context_);
    session.share_frames(std::make_unique<KnownTimes>(stalls));
    interaction::Commands first;
    first.isovalue = 0.1;
    FrameReport report = frame(session, false, first);
    std::uint64_t most = 0;
    int coarse = 0; // pictures in slices
    ASSERT_TRUE(test_support::eventually([&] {
        report = frame(session, false);
        if (!report.redrawn || report.reason != QualityReason::in_slices)
            return report.final && report.cells > 0;
        EXPECT_GE(report.cells, most);
        most = report.cells;
        coarse += report.coarsest > 0;
        stalls = coarse > 0;
        return false;
    }));
    EXPECT_EQ(coarse, 1);
    EXPECT_EQ(report.coarsest, 0u);
    EXPECT_GT(most, 3 * kFew);
}

TEST_P(SessionDetail, AllCellsAreFoundWhileTheFirstOnesAreDrawnWhichAreSeenAllTheSame) {
    Config config = config_with(1e-6);
    config.still_budget_ms = 2;
    const bool stalls = false;
    const render::Gl gl(context_->loader());
    const index::Extract real =
        index::extract_from(large_, std::nullopt, render::CellBuffers::wanted_shading(gl));
    std::atomic<bool> all_found = false;
    Session session(config, large_, *context_,
                    [&](const index::SurfacesQuery& query, std::stop_token stop) {
                        index::ExtractionPtr set = real(query, stop);
                        if (set && query.detail.at_rest && !set->coarse())
                            all_found = true;
                        return set;
                    });
    session.share_frames(std::make_unique<KnownTimes>(stalls));
    interaction::Commands first;
    first.isovalue = 0.1;
    FrameReport report = frame(session, false, first);
    ASSERT_TRUE(test_support::eventually([&] {
        report = frame(session, false);
        return report.in_slices && report.cells > 15'000 && report.coarsest > 0;
    })) << "the first set at rest, of 18,524 cells";
    report = frame(session, false);
    ASSERT_NE(report.footprint, report.in_slices) << "a piece in each frame";
    ASSERT_TRUE(test_support::eventually([&] { return all_found.load(); }));
    int coarse = 0; // pictures in slices
    ASSERT_TRUE(test_support::eventually([&] {
        report = frame(session, false);
        coarse +=
            report.redrawn && report.reason == QualityReason::in_slices && report.coarsest > 0;
        return report.final && report.coarsest == 0;
    }));
    EXPECT_EQ(coarse, 1);
}

TEST_P(SessionDetail, AnythingThatMayStillMoveHasTheBudgetOfAFrame) {
    Session session(config_with(1e-6), file_, *context_);
    FrameReport report = frame(session, false);
    ASSERT_TRUE(test_support::eventually([&] { return (report = frame(session, false)).final; }));
    EXPECT_NE(report.footprint, render::Footprint::quad);
    interaction::InputState input = head_at_rest(frame_++ / 60.0);
    input.devices[0].pose->position.x = 0.3f;
    report = session.frame(input, {}, Waiting::never);
    ASSERT_EQ(report.pace, interaction::Pace::moving);
    int still = 0;
    for (int i = 0; i < 60 && report.pace == interaction::Pace::moving; ++i) {
        EXPECT_EQ(report.footprint, render::Footprint::quad) << i;
        report = frame(session, false); // where it was before
        ++still;
    }
    EXPECT_GT(still, 7) << "longer than until a picture is taken for still";
}

class SessionWithLittleRoom : public SessionDetail {
  protected:
    static constexpr int kRoom = 40'000; ///< cells
    SessionWithLittleRoom() { little = {}; }
    static interaction::Commands at(double isovalue) {
        interaction::Commands commands;
        commands.isovalue = isovalue;
        return commands;
    }
    /// Frames until a set of that isovalue is shown and none is refused any more. What is shown
    /// meanwhile is what was shown before.
    void expect_coarser_cells(Session& session, double isovalue, const std::string& why) {
        const FrameReport before = frame(session, false, at(isovalue));
        FrameReport report = before;
        int refused = 0, at_peace = 0;
        ASSERT_TRUE(test_support::eventually([&] {
            report = frame(session, true);
            if (!report.refused.empty()) {
                ++refused;
                EXPECT_TRUE(report.refused.ends_with(why)) << report.refused;
            }
            const bool new_ones = report.shown && report.shown->isovalues.front() == isovalue;
            if (!new_ones) {
                EXPECT_EQ(report.cells, before.cells);
            }
            at_peace = new_ones && report.refused.empty() ? at_peace + 1 : 0;
            return at_peace > 20;
        }));
        EXPECT_GT(refused, 0);
        EXPECT_GT(report.coarsest, 0u);
        EXPECT_GT(report.cells, 1000u);
        EXPECT_LE(report.cells, std::uint64_t{kRoom});
    }

    stereo::ContextInBetween context_of_little_{GetParam(), {256, 128}, with_little_room};
};

TEST_P(SessionWithLittleRoom, ASetThatTheDriverCannotHoldGivesWayToACoarserOne) {
    little.texels = kRoom;
    Session session(config_with(1e6), large_, context_of_little_);
    expect_coarser_cells(session, 0.1, "this GL can draw at most 40000, so the last ones stay");
    FrameReport report = frame(session, true, at(2.0));
    ASSERT_TRUE(test_support::eventually([&] {
        report = frame(session, true);
        EXPECT_EQ(report.refused, "") << "it is known what fits";
        return report.shown->isovalues.front() == 2.0;
    }));
}

TEST_P(SessionWithLittleRoom, ASetWithoutMemoryGivesWayHoweverOftenTheWordsAreTheSame) {
    Session session(config_with(1e6), large_, context_of_little_);
    FrameReport report = frame(session, true, at(2.95)); // specks
    ASSERT_TRUE(test_support::eventually([&] {
        report = frame(session, true);
        return report.cells > 0;
    }));
    ASSERT_LT(report.cells, 5000u);
    little.bytes = kRoom * GLsizeiptr{sizeof(index::CellPoint)};
    expect_coarser_cells(session, 0.1, ", so the last cells stay");
}

TEST_P(SessionWithLittleRoom, AReplayShowsCoarserCellsInTheSameFrame) {
    little.texels = kRoom;
    Session session(config_with(1e6), large_, context_of_little_);
    for (int i = 0; i < 3; ++i) {
        const FrameReport report = session.frame(
            head_at_rest(i), i == 0 ? at(0.1) : interaction::Commands(), Waiting::for_cells);
        EXPECT_GT(report.cells, 1000u);
        EXPECT_LE(report.cells, std::uint64_t{kRoom});
        EXPECT_GT(report.coarsest, 0u);
        EXPECT_EQ(report.refused, "");
    }
}

INSTANTIATE_TEST_SUITE_P(, SessionWithLittleRoom, testing::Values(stereo::ContextKind::egl),
                         context_name);
INSTANTIATE_TEST_SUITE_P(Contexts, SessionDetail,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

} // namespace
} // namespace isochron::app
