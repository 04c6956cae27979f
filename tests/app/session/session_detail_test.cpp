// Levels of detail in a session: what moves or sways is shown a set that fits, what rests all
// cells.
#include "tests/app/session/large_session.h"
#include "tests/support/drawing/context_in_between.h"

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
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

TEST_P(SessionDetail, AHeadThatSwaysIsShownTheSetForMotionAndOneAtRestAllCells) {
    Session session(config_with(1e-6), large_, *context_); // no number of cells fits
    FrameReport report = first_frame(session, true);
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
            EXPECT_EQ(report.reason, QualityReason::in_parts) << "no frame holds all cells";
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

TEST_P(SessionDetail, AllCellsMoveFromTheFirstFrameOnWhereTheyFit) {
    for (const double budget : {1e7, 1e-6}) {
        SCOPED_TRACE(budget);
        Session session(config_with(budget), large_, *context_);
        FrameReport report = first_frame(session, false);
        ASSERT_TRUE(test_support::eventually([&] {
            report = frame(session, false);
            return report.coarsest == 0 && report.cells > 0 && report.final;
        }));
        const std::uint64_t all = report.cells;
        interaction::InputState input = head_at_rest(frame_++ / 60.0);
        input.devices[0].pose->position.x = 0.3f;
        report = session.frame(input, {}, Waiting::never);
        ASSERT_EQ(report.pace, interaction::Pace::moving);
        EXPECT_EQ(report.cells == all, budget > 1);
        EXPECT_NE(report.footprint, render::Footprint::gaussian);
        EXPECT_EQ(report.slower, false);
    }
}

TEST_P(SessionDetail, MeshesThatComeAtRestDropNoPicture) {
    const bool have_meshes =
        render::CellBuffers::wanted_shading(render::Gl(context_->loader())) != index::Shading::none;
    Session session(config_with(1e-6), large_, *context_);
    FrameReport report = first_frame(session, true);
    ASSERT_TRUE(test_support::eventually([&] {
        report = frame(session, false);
        return report.cells > 0 && report.coarsest == 0 && report.final;
    }));
    ASSERT_EQ(report.footprint, render::Footprint::surface);
    std::uint64_t sent = 0;
    ASSERT_TRUE(test_support::eventually([&] {
        report = frame(session, false);
        EXPECT_FALSE(report.redrawn);
        EXPECT_TRUE(report.final);
        EXPECT_EQ(report.footprint, render::Footprint::surface);
        sent += report.uploaded.mesh_bytes;
        return !have_meshes || (sent > 0 && report.uploaded.mesh_bytes == 0);
    }));
}

TEST_P(SessionDetail, WhatMovesCanBeRecognizedHoweverSmallTheBudget) {
    for (const double longest_ms : {0.0, 1000.0}) {
        SCOPED_TRACE(longest_ms);
        Config config = config_with(1e-6);
        config.quality.longest_ms = longest_ms;
        Session session(config, large_, *context_);
        FrameReport report = first_frame(session, true);
        std::uint64_t all = 0;
        ASSERT_TRUE(test_support::eventually([&] { // they are counted at rest
            report = frame(session, false);
            all = report.volume_cells.value_or(0);
            return all > 0 && report.final;
        }));
        ASSERT_TRUE(test_support::eventually([&] {
            report = frame(session, true);
            return report.coarsest > 0 &&
                   report.cells >= all / 12; // whole levels, so about an eighth
        }));
        for (int i = 0; i < 60; ++i) {
            report = frame(session, true);
            EXPECT_GE(report.cells, all / 12) << i;
        }
        EXPECT_EQ(report.slower, longest_ms > 0);
        EXPECT_EQ(report.promised > Milliseconds(1e-6), longest_ms > 0);
        EXPECT_LE(report.promised, Milliseconds(1000));
    }
}

/// Pixels of the first window that are not the background's.
double lit_of(const Session& session) {
    const auto rgba = session.outputs().display().read_window().rgba;
    std::size_t lit = 0;
    for (std::size_t i = 0; i < rgba.size(); i += 4)
        lit += rgba[i] > 60;
    return static_cast<double>(lit) / static_cast<double>(rgba.size() / 4);
}

TEST_P(SessionDetail, FewerPixelsOfTheCellsKeepTheirRimsAndAreGivenUpBeforeCells) {
    Config config = config_with(1e-6);
    config.installation.windows.front().stereo = stereo::StereoMode::mono;
    config.start.bounding_box = false;
    const auto moving = [&](double budget_ms, std::size_t& resolution) {
        Config own = config;
        own.quality.frame_budget_ms = budget_ms;
        own.quality.least_resolution = 0.35;
        own.rendering.level_of_detail = false; // all cells
        Session session(own, large_, *context_);
        FrameReport report = first_frame(session, true);
        EXPECT_TRUE(test_support::eventually([&] {
            report = frame(session, true);
            return report.cells > 0 && report.redrawn && (report.resolution > 0 || budget_ms > 1) &&
                   report.expected;
        }));
        resolution = report.resolution;
        return lit_of(session);
    };
    std::size_t few = 0, all = 0;
    const double lit = moving(1e-6, few), whole = moving(1e7, all);
    EXPECT_GT(few, 0u);
    EXPECT_EQ(all, 0u);
    EXPECT_GT(whole, 0.05);
    EXPECT_NEAR(lit / whole, 1.0, 0.06);
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
        EXPECT_TRUE(report.footprint == render::Footprint::quad ||
                    report.footprint == render::Footprint::mesh) // which takes about as long
            << i;
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
        commands.quality = interaction::QualityMode::fast; // splats and surfaces need memory, too
        return commands;
    }
    /// Frames until a set of that isovalue was refused, and another one is shown and none refused
    /// any more. What is shown meanwhile is what was shown before.
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
            return refused > 0 && at_peace > 20;
        }));
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
