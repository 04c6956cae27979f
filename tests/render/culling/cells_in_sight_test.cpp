// Opaque surfaces without the cells that nearer ones hide.
#include "render/culling/cells_in_sight.h"

#include "render/gl/driver.h"
#include "render/gl/render_target.h"
#include "tests/render/cells/surface_agreement.h"
#include "tests/support/test_field.h"

#include <limits>

namespace isochron::render {
namespace {

using index::TestField;
using index::ValueType;

class CellsInSightTest : public SurfaceTest {
  protected:
    CellsInSightTest() { all_.draw_hidden_cells(); }

    CellBuffers cells_of(const index::StepValues& values, double isovalue) {
        CellBuffers cells(gl_, values.grid);
        const index::ExtractionPtr active = Extractions(values).active(0, {isovalue});
        while (cells.shown() != active)
            cells.upload(active, std::numeric_limits<std::size_t>::max());
        return cells;
    }
    /// @param together work that is drawn at a time
    std::vector<std::uint8_t> drawn(CellPass& pass, std::span<const View> views,
                                    const Placement& placement, const CellBuffers& cells,
                                    std::size_t together, const CellAppearance& look = {}) {
        glm::ivec2 size(1);
        for (const View& view : views)
            size = glm::max(size, view.corner + view.size);
        RenderTarget target(gl_, size, samples_);
        target.bind();
        target.clear(glm::vec4(0.0f));
        parts_ = 0;
        const std::size_t work = pass.work(views.size(), cells, Footprint::surface, look);
        for (std::size_t done = 0; done < work; ++parts_)
            done += pass.draw(views, placement, cells, Footprint::surface, look, {done, together});
        target.resolve();
        return target.read().rgba;
    }
    /// Noise, through which nobody sees far.
    const TestField noise_{{56, 50, 53}, 1, ValueType::u8, index::white_noise(random_)};
    const Placement placement_ = placed_at_origin(noise_.view().grid);
    CellPass seen_{gl_}, all_{gl_};
    int samples_ = 1; ///< samples of a pixel
    int parts_ = 0;
    static constexpr std::size_t kWhole = std::numeric_limits<std::size_t>::max();
};

TEST_P(CellsInSightTest, ThoseThatAreLeftOutChangeNoPixel) {
    const CellBuffers cells = cells_of(noise_.view(), 0.01);
    ASSERT_GT(cells.size(), CornerWindow::kCells);
    const glm::vec3 outside(0.9f, 0.7f, 1.6f), inside(0.1f, 0.05f, 0.2f);
    for (const glm::vec3& eye : {outside, inside}) {
        std::array<View, 2> views{perspective_view(eye), perspective_view(1.05f * eye)};
        views[0].corner = {7, 12};
        views[1].corner = views[0].corner + glm::ivec2(views[0].size.x + 3, 5);
        for (const std::size_t number : {1, 2}) {
            const auto some = std::span(views).first(number);
            const auto picture = drawn(all_, some, placement_, cells, kWhole);
            EXPECT_TRUE(drawn(seen_, some, placement_, cells, kWhole) == picture);
            EXPECT_TRUE(drawn(seen_, some, placement_, cells, 9'999) == picture);
        }
    }
}

TEST_P(CellsInSightTest, WithSeveralSamplesAPixelAllThatIsInViewIsDrawn) {
    samples_ = 4;
    const CellBuffers cells = cells_of(noise_.view(), 0.01);
    const View far = perspective_view({9, 7, 16}); // cells are smaller than pixels
    EXPECT_TRUE(drawn(seen_, std::span(&far, 1), placement_, cells, 5000) ==
                drawn(all_, std::span(&far, 1), placement_, cells, 5000));
}

TEST_P(CellsInSightTest, TheyTakeLessWorkWhereTheProcessorDraws) {
    const CellBuffers cells = cells_of(noise_.view(), 0.01);
    const View view = perspective_view({0.9f, 0.7f, 1.6f});
    drawn(all_, std::span(&view, 1), placement_, cells, 5000);
    const int all = parts_;
    drawn(seen_, std::span(&view, 1), placement_, cells, 5000);
    if (is_drawn_for_processor(gl_))
        EXPECT_LT(parts_, all / 2);
    else // a GPU draws them all
        EXPECT_EQ(parts_, all);
}

TEST_P(CellsInSightTest, APictureThatIsTakenUpAfterAnotherIsTheSame) {
    const CellBuffers cells = cells_of(noise_.view(), 0.01);
    const View view = perspective_view({0.9f, 0.7f, 1.6f}), other = perspective_view({-1, 0.5f, 1});
    const auto both = [&](CellPass& pass) {
        std::array<RenderTarget, 2> targets{RenderTarget(gl_, view.size),
                                            RenderTarget(gl_, view.size)};
        for (RenderTarget& target : targets) {
            target.bind();
            target.clear(glm::vec4(0.0f));
        }
        std::array<std::size_t, 2> done{};
        const std::size_t work = pass.work(1, cells, Footprint::surface, {});
        while (std::min(done[0], done[1]) < work)
            for (const std::size_t i : {0, 1}) {
                targets[i].bind();
                done[i] += pass.draw(std::span(i == 0 ? &view : &other, 1), placement_, cells,
                                     Footprint::surface, {}, {done[i], 20'000});
            }
        return std::array{targets[0].read().rgba, targets[1].read().rgba};
    };
    EXPECT_TRUE(both(seen_) == both(all_));
}

TEST_P(CellsInSightTest, APictureThatGoesOnWhereAnotherStoppedIsAnother) {
    const CellBuffers cells = cells_of(noise_.view(), 0.01);
    const View view = perspective_view({0.9f, 0.7f, 1.6f}), other = perspective_view({-1, 0.5f, 1});
    RenderTarget target(gl_, view.size);
    target.bind();
    target.clear(glm::vec4(0.0f));
    const std::size_t done =
        seen_.draw(std::span(&other, 1), placement_, cells, Footprint::surface, {}, {0, 20'000});
    ASSERT_LT(done, seen_.work(1, cells, Footprint::surface, {}) / 2);
    const auto rest_of = [&](CellPass& pass) {
        target.clear(glm::vec4(0.0f));
        pass.draw(std::span(&view, 1), placement_, cells, Footprint::surface, {}, {done, kWhole});
        return target.read().rgba;
    };
    EXPECT_TRUE(rest_of(seen_) == rest_of(all_));
}

TEST_P(CellsInSightTest, WhatIsCutAwayNearTheEyeHidesNothing) {
    const CellBuffers cells = cells_of(noise_.view(), 0.01);
    const View view = perspective_view({0.9f, 0.7f, 1.6f});
    CellAppearance look;
    look.cuts = {glm::vec4(0.0f, 0.0f, 1.0f, -0.2f)}; // all beyond z = 0.2
    const auto picture = drawn(all_, std::span(&view, 1), placement_, cells, kWhole, look);
    EXPECT_TRUE(drawn(seen_, std::span(&view, 1), placement_, cells, kWhole, look) == picture);
    EXPECT_FALSE(drawn(seen_, std::span(&view, 1), placement_, cells, kWhole) == picture);
}

TEST_P(CellsInSightTest, DepthsAreThoseOfTheViewport) {
    const RenderTarget target(gl_, {60, 40});
    target.bind();
    target.clear(glm::vec4(0.0f));
    gl_.Enable(GL_SCISSOR_TEST);
    gl_.Scissor(10, 8, 22, 32);
    gl_.ClearDepth(0.5);
    gl_.Clear(GL_DEPTH_BUFFER_BIT);
    gl_.Disable(GL_SCISSOR_TEST);
    gl_.ClearDepth(1.0);
    View view;
    view.corner = {10, 8};
    view.size = {37, 32};
    DrawnDepths depths;
    depths.clear(gl_, view);
    EXPECT_FALSE(depths.hide({{2, 2}, {3, 3}, 0.9f}));
    depths.read(gl_, view);
    EXPECT_TRUE(depths.hide({{2, 2}, {3, 3}, 0.51f}));
    EXPECT_TRUE(depths.hide({{-5, -5}, {19, 99}, 0.51f}));
    EXPECT_FALSE(depths.hide({{2, 2}, {3, 3}, 0.5f}));
    EXPECT_TRUE(depths.hide({{2, 2}, {22.4f, 3}, 0.51f})); // up to the middle of a pixel
    EXPECT_FALSE(depths.hide({{2, 2}, {22.6f, 3}, 0.51f}));
    EXPECT_TRUE(depths.hide({{30.6f, 2}, {31.4f, 3}, 0.0f})); // between two of these
    EXPECT_FALSE(depths.hide({{30, 2}, {31, 3}, 0.99f}));
    const RenderTarget many(gl_, {60, 40}, 4);
    many.bind();
    depths.clear(gl_, view);
    depths.read(gl_, view); // cannot be read
    EXPECT_FALSE(depths.hide({{2, 2}, {3, 3}, 0.51f}));
    EXPECT_FALSE(depths.hide({{30.6f, 2}, {31.4f, 3}, 0.99f})); // may hold a sample
}

INSTANTIATE_TEST_SUITE_P(, CellsInSightTest, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
