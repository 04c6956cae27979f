// The last exact picture is moved, by its depth, before a worse one is drawn.
#include "render/gl/driver.h"
#include "tests/app/session/quality_session.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace isochron::app {
namespace {

using interaction::Commands;
using render::Footprint;

class MovedPicture : public SessionQuality {
  protected:
    FrameReport with_head(Session& session, glm::vec3 aside, const Commands& commands = {},
                          Waiting waiting = Waiting::never) {
        interaction::InputState input = head_at_rest(now().count());
        ++frame_;
        input.devices[0].pose->position += aside;
        return session.frame(input, commands, waiting);
    }
    /// Share of the pixels that cells light in either picture, but not alike in both.
    static double unlike(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b,
                         const std::vector<std::uint8_t>& without) {
        std::size_t either = 0, off = 0;
        const auto differs = [](const auto& x, const auto& y, std::size_t at) {
            for (std::size_t i = at; i < at + 3; ++i)
                if (std::abs(x[i] - y[i]) > 24)
                    return true;
            return false;
        };
        for (std::size_t at = 0; at < a.size(); at += 4) {
            either += differs(a, without, at) || differs(b, without, at);
            off += differs(a, b, at);
        }
        return static_cast<double>(off) / static_cast<double>(either);
    }
    /// What is settled where this head is.
    std::vector<std::uint8_t> settled_at(glm::vec3 aside, const Commands& commands = {}) {
        Session session(config_with(kPlenty), file_, *context_);
        with_head(session, aside, commands, Waiting::for_cells);
        for (int i = 0; i < 3; ++i)
            with_head(session, aside, {}, Waiting::for_cells);
        return shown(session);
    }
    std::vector<std::uint8_t> without_cells_at(glm::vec3 aside) {
        Commands none;
        none.isovalue = 1e6;
        return settled_at(aside, none);
    }
};
INSTANTIATE_TEST_SUITE_P(Contexts, MovedPicture,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

TEST_P(MovedPicture, IsThatOfTheNewPlaceWhereTheOldOneWouldNotBe) {
    Session session(config_in_parts(), file_, *context_);
    start(session);
    rest_until(session, is_exact);
    const auto before = shown(session);
    const glm::vec3 aside(0.03f, 0.01f, -0.01f);
    const FrameReport report = with_head(session, aside);
    EXPECT_TRUE(report.moved);
    EXPECT_TRUE(report.redrawn);
    EXPECT_FALSE(report.final);
    const auto moved = shown(session), wanted = settled_at(aside),
               without = without_cells_at(aside);
    EXPECT_LT(unlike(moved, wanted, without), 0.3 * unlike(before, wanted, without));
    EXPECT_LT(unlike(moved, wanted, without), 0.08);
    // And it ends at the exact picture.
    FrameReport last;
    EXPECT_TRUE(test_support::eventually([&] {
        last = with_head(session, aside);
        return is_exact(last);
    }));
    EXPECT_FALSE(last.moved);
    Session other(config_in_parts(), file_, *context_);
    EXPECT_TRUE(test_support::eventually([&] { return is_exact(with_head(other, aside)); }));
    EXPECT_TRUE(test_support::eventually([&] { // both with all samples of their pixels
        with_head(session, aside);
        with_head(other, aside);
        return !session.outlook().busy && !other.outlook().busy;
    }));
    EXPECT_TRUE(shown(session) == shown(other));
}

TEST_P(MovedPicture, FollowsDataThatMoveALittle) {
    Session session(config_in_parts(), file_, *context_);
    start(session);
    rest_until(session, is_exact);
    const auto before = shown(session);
    Commands move;
    move.room_from_physical = session.state().room_from_physical;
    move.room_from_physical->translation += glm::dvec3(0.02, 0.02, 0.01);
    const FrameReport report = with_head(session, {}, move);
    EXPECT_TRUE(report.moved);
    const auto wanted = settled_at({}, move), without = without_cells_at({});
    EXPECT_LT(unlike(shown(session), wanted, without), 0.3 * unlike(before, wanted, without));
}

TEST_P(MovedPicture, IsGivenUpBeyondAFewCentimetersAndForOtherCells) {
    Session session(config_in_parts(), file_, *context_);
    start(session);
    rest_until(session, is_exact);
    EXPECT_TRUE(with_head(session, {0.03f, 0, 0}).moved);
    EXPECT_FALSE(with_head(session, {0.05f, 0, 0}).moved);
    EXPECT_TRUE(with_head(session, {0.03f, 0, 0}).moved) << "it is there still";
    Commands other;
    other.isovalue = 1.01 * session.state().isovalue();
    EXPECT_FALSE(with_head(session, {0.02f, 0, 0}, other).moved);
}

TEST_P(MovedPicture, IsNotShownInReplaysNorWhereAnotherQualityIsAsked) {
    Session session(config_in_parts(), file_, *context_);
    start(session);
    rest_until(session, is_exact);
    Commands paper;
    paper.quality = interaction::QualityMode::paper;
    EXPECT_FALSE(with_head(session, {0.01f, 0, 0}, paper).moved);
    Session replay(config_in_parts(), file_, *context_);
    for (int i = 0; i < 30; ++i)
        with_head(replay, {}, {}, Waiting::for_cells);
    EXPECT_FALSE(with_head(replay, {0.02f, 0, 0}, {}, Waiting::for_cells).moved);
}

/// Frames of a session in which a surface that is drawn at once takes very long.
class SurfacesTakeLong final : public FramesAlone {
  public:
    std::vector<DrawSample> samples(std::vector<DrawSample> mine) override {
        for (DrawSample& sample : mine)
            if (sample.footprint == Footprint::surface)
                sample.processor = Milliseconds(1e6);
        return mine;
    }
};

TEST_P(MovedPicture, ComesAnewWhileTheHeadSways) {
    Config config = config_with(1e4);
    config.quality.still_budget_ms = 1e4;
    config.memory.mesh_megabytes = 0; // all triangles are as good as a moved picture
    Session session(config, file_, *context_);
    session.share_frames(std::make_unique<SurfacesTakeLong>());
    start(session);
    rest_until(session, is_exact);
    int moved = 0, far = 0;
    for (int i = 0; i < 200; ++i) {
        const float x = 0.001f * static_cast<float>(i);
        const bool is = with_head(session, {x, 0, 0}).moved;
        moved += is;
        far += is && x > 0.1f;
    }
    EXPECT_GT(moved, 100);
    EXPECT_GT(far, 50) << "a picture of where the head was at first goes to 0.04 m";
}

/// A context that says that it is a window, so that a panel lies over it.
class AsAWindow final : public stereo::GlContext {
  public:
    explicit AsAWindow(stereo::ContextKind kind)
        : context_(stereo::make_context(kind, {.size = kSize})) {}
    void make_current() override { context_->make_current(); }
    render::GlLoader loader() const override { return context_->loader(); }
    glm::ivec2 framebuffer_size() const override { return kSize; }
    bool has_window() const override { return true; }
    void present() override {}
    bool should_close() const override { return false; }
    std::vector<interaction::WindowEvent> poll_events() override { return {}; }
    std::string description() const override { return "as a window"; }

  private:
    static constexpr glm::ivec2 kSize{640, 480};
    std::unique_ptr<stereo::GlContext> context_;
};

TEST_P(MovedPicture, IsTheExactOneInAnotherSizeWhereThePanelComesOrGoes) {
    Config config = config_with(1e4);
    config.quality.still_budget_ms = 1e4;
    config.installation.windows.front().stereo = stereo::StereoMode::mono;
    AsAWindow window(GetParam());
    Session session(config, file_, window);
    session.share_frames(std::make_unique<SurfacesTakeLong>());
    start(session);
    rest_until(session, is_exact);
    // All triangles would be as good where an eye has moved, and they are there: in the ways of a
    // GPU there are none.
    if (float x = 0; render::is_drawn_for_processor(session.outputs().gl()))
        EXPECT_TRUE(test_support::eventually([&] {
            const FrameReport report = with_head(session, {x = 0.005f - x, 0, 0});
            return report.footprint == Footprint::mesh && !report.moved;
        }));
    rest_until(session, is_exact);
    const auto picture = [&] { return session.outputs().display().read_eye(stereo::Eye::center); };
    for (const bool panel : {false, true, false}) {
        SCOPED_TRACE(panel);
        const render::Image before = picture();
        Commands tab;
        tab.panel = panel;
        FrameReport report = rest(session, 1, tab);
        EXPECT_TRUE(report.moved);
        const render::Image first = picture();
        EXPECT_NE(first.height, before.height);
        EXPECT_TRUE(test_support::eventually([&] {
            report = rest(session, 1);
            EXPECT_TRUE(report.moved || report.footprint == Footprint::surface);
            return is_exact(report);
        }));
        const render::Image exact = picture();
        std::vector<std::uint8_t> none(exact.rgba.size());
        for (std::size_t i = 0; i < none.size(); i += 4)
            std::copy_n(exact.rgba.begin(), 4, none.begin() + static_cast<std::ptrdiff_t>(i));
        EXPECT_LT(unlike(first.rgba, exact.rgba, none), 0.1);
    }
}

TEST_P(MovedPicture, IsNotOfTranslucentSurfacesWhichStayAsTheyAreUntilTheyAreDrawnBesideThePanel) {
    Config config = config_in_parts();
    config.installation.windows.front().stereo = stereo::StereoMode::mono;
    AsAWindow window(GetParam());
    Session session(config, file_, window);
    Commands look;
    look.isosurfaces = {{{2.0, {0.9f, 0.3f, 0.2f}, 0.4f}, {8.0, {0.2f, 0.5f, 0.9f}, 1.0f}}};
    session.frame(head_at_rest(0), look, Waiting::for_cells);
    rest_until(session, is_exact);
    const auto picture = [&] { return session.outputs().display().read_eye(stereo::Eye::center); };
    for (const bool panel : {false, true}) {
        SCOPED_TRACE(panel);
        const render::Image before = picture();
        Commands tab;
        tab.panel = panel;
        int frames = 0;
        EXPECT_TRUE(test_support::eventually([&] {
            const FrameReport report = rest(session, 1, frames++ == 0 ? tab : Commands{});
            const render::Image now = picture();
            EXPECT_EQ(report.footprint, Footprint::surface) << "drawn anew or kept";
            if (!report.redrawn && !is_exact(report))
                EXPECT_TRUE(now.rgba == before.rgba && now.height == before.height);
            return is_exact(report);
        }));
        EXPECT_GT(frames, 3);
        EXPECT_NE(picture().height, before.height);
    }
    // As one that was drawn so from the start.
    Session other(config, file_, window);
    other.frame(head_at_rest(0), look, Waiting::for_cells);
    rest_until(other, is_exact);
    EXPECT_TRUE(picture().rgba == other.outputs().display().read_eye(stereo::Eye::center).rgba);
}

} // namespace
} // namespace isochron::app
