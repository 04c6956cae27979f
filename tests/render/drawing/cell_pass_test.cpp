// The two renderers: depth, order, light, large sets, and the number of sorts.
#include "render/drawing/cell_pass.h"
#include "render/gl/driver_trials.h"
#include "render/gl/render_target.h"
#include "render/gl/srgb.h"
#include "tests/render/cells/extractions.h"
#include "tests/support/drawing/gl_test.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace isochron::render {
namespace {

constexpr int kSize = 101;

class CellPasses : public GlTest {
  protected:
    /// The volume's z axis goes away from the eye at (0.5, 0.5) of x and y; one voxel is a meter.
    CellPasses() {
        view_.size = {kSize, kSize};
        view_.clip_from_eye = glm::perspective(0.5f, 1.0f, 0.1f, 200.0f);
        placement_.room_from_index = glm::scale(
            glm::translate(glm::mat4(1.0f), glm::vec3(-0.5f, -0.5f, -20.0f)), glm::vec3(1, 1, -1));
        placement_.room_from_physical = glm::mat3(glm::scale(glm::mat4(1.0f), glm::vec3(1, 1, -1)));
        placement_.extent = glm::vec3(40.0f);
        // The head light alone, on something that mirrors nothing.
        appearance_.depth_cue = appearance_.reflectance = 0.0f;
        appearance_.key_light = appearance_.outline = appearance_.ambient = 0.0f;
        appearance_.head_light = 1.0f;
        target_.bind();
        target_.clear({0, 0, 0, 0});
    }
    void draw(const CellBuffers& cells, Footprint footprint) {
        pass_.draw(view_, placement_, cells, footprint, appearance_);
    }
    int red(int x, int y) { return target_.read().at(x, y)[0]; }
    int red_in_the_middle() { return red(kSize / 2, kSize / 2); }
    float depth_in_the_middle() {
        float depth = 0.0f;
        target_.bind();
        gl_.ReadPixels(kSize / 2, kSize / 2, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
        return depth;
    }
    float depth_of_cell(int z) {
        const glm::vec4 p = view_.clip_from_eye * view_.eye_from_room * placement_.room_from_index *
                            glm::vec4(0.5f, 0.5f, static_cast<float>(z) + 0.5f, 1.0f);
        return 0.5f + 0.5f * p.z / p.w;
    }
    /// The mark that tells two cells apart: how they face the light.
    static constexpr glm::vec3 kFacing{0, 0, 1}, kEdgeOn{1, 0, 0};
    std::vector<index::CellPoint> marked(int facing_z, int edge_on_z) {
        std::vector<index::CellPoint> points;
        for (const int z : {std::min(facing_z, edge_on_z), std::max(facing_z, edge_on_z)})
            points.push_back(
                {0, 0, std::uint16_t(z), 0, packed_normal(z == facing_z ? kFacing : kEdgeOn)});
        return points;
    }

    View view_;
    Placement placement_;
    CellAppearance appearance_;
    RenderTarget target_{gl_, {kSize, kSize}};
    CellPass pass_{gl_, {.shape = CellShape::voxel}};
};

TEST_P(CellPasses, QuadsWriteTheDepthOfTheirCellsCenter) {
    draw(showing(gl_, cell_set({{0, 0, 7}})), Footprint::quad);
    EXPECT_NEAR(depth_in_the_middle(), depth_of_cell(7), 1e-6f);
}

TEST_P(CellPasses, TheNearerQuadIsSeenWhicheverComesFirst) {
    for (const auto& [facing, edge_on] : {std::pair{3, 6}, std::pair{6, 3}}) {
        target_.clear({0, 0, 0, 0});
        draw(showing(gl_, marked(facing, edge_on)), Footprint::quad);
        EXPECT_NEAR(depth_in_the_middle(), depth_of_cell(3), 1e-6f);
        EXPECT_EQ(red_in_the_middle() > 150, facing < edge_on);
    }
}

TEST_P(CellPasses, TheNearerSplatLiesOverTheOtherFromEitherSide) {
    for (const bool from_behind : {false, true})
        for (const auto& [facing, edge_on] : {std::pair{3, 6}, std::pair{6, 3}}) {
            view_.eye_from_room = from_behind ? glm::lookAt(glm::vec3(0, 0, -60),
                                                            glm::vec3(0, 0, 0), glm::vec3(0, 1, 0))
                                              : glm::mat4(1.0f);
            target_.clear({0, 0, 0, 0});
            draw(showing(gl_, marked(facing, edge_on)), Footprint::gaussian);
            EXPECT_EQ(red_in_the_middle() > 150, (facing < edge_on) != from_behind);
        }
}

TEST_P(CellPasses, SplatsAreHiddenBehindQuadsAndLeaveTheirDepth) {
    draw(showing(gl_, cell_set({{0, 0, 3}}, packed_normal(kFacing))), Footprint::quad);
    const int before = red_in_the_middle();
    const float depth = depth_in_the_middle();
    draw(showing(gl_, cell_set({{0, 0, 9}}, packed_normal(kEdgeOn))), Footprint::gaussian);
    EXPECT_EQ(red_in_the_middle(), before);
    draw(showing(gl_, cell_set({{0, 0, 1}}, packed_normal(kEdgeOn))), Footprint::gaussian);
    EXPECT_LT(red_in_the_middle(), before);
    EXPECT_EQ(depth_in_the_middle(), depth);
}

TEST_P(CellPasses, BothSidesOfACellAreLitAlikeAndOneWithoutNormalFacesTheViewer) {
    std::vector<int> reds;
    for (const std::uint32_t normal : {packed_normal(kFacing), packed_normal(-kFacing), 0u}) {
        target_.clear({0, 0, 0, 0});
        draw(showing(gl_, cell_set({{0, 0, 3}}, normal)), Footprint::quad);
        reds.push_back(red_in_the_middle());
    }
    EXPECT_NEAR(reds[0], reds[1], 1);
    EXPECT_NEAR(reds[0], reds[2], 1);
    EXPECT_NEAR(reds[0], 255 * appearance_.surfaces[0].color.x,
                3); // full light gives the color itself
}

TEST_P(CellPasses, LightFallsOffWithTheAngleOfTheNormal) {
    appearance_.surfaces[0].color = glm::vec3(1.0f);
    // A zero normal would face the viewer, so the angles stay below a right one.
    for (const float angle : {0.0f, 0.5f, 1.0f, 1.4f}) {
        target_.clear({0, 0, 0, 0});
        const glm::vec3 normal(std::sin(angle), 0.0f, std::cos(angle));
        draw(showing(gl_, cell_set({{0, 0, 3}}, packed_normal(normal))), Footprint::quad);
        EXPECT_NEAR(red_in_the_middle(), 255 * srgb_from_linear(std::cos(angle)), 2) << angle;
    }
}

TEST_P(CellPasses, NormalsTurnWithTheVolume) {
    const glm::mat4 quarter = glm::rotate(glm::mat4(1.0f), glm::radians(90.0f), glm::vec3(0, 1, 0));
    placement_.room_from_physical = glm::mat3(quarter) * placement_.room_from_physical;
    draw(showing(gl_, cell_set({{0, 0, 3}}, packed_normal(kEdgeOn))), Footprint::quad);
    EXPECT_NEAR(red_in_the_middle(), 255 * appearance_.surfaces[0].color.x, 3);
}

TEST_P(CellPasses, EveryCellOfALargeSetIsDrawn) {
    // More than one batch of quads: the last cells alone are in view.
    std::vector<glm::ivec3> cells(40000, glm::ivec3(0, 30000, 1));
    cells.back() = {0, 0, 5};
    for (const Footprint footprint : {Footprint::quad, Footprint::gaussian}) {
        target_.clear({0, 0, 0, 0});
        placement_.extent = glm::vec3(1, 30001, 40);
        draw(showing(gl_, cell_set(cells, packed_normal(kFacing))), footprint);
        EXPECT_GT(red_in_the_middle(), 150);
    }
}

TEST_P(CellPasses, AStandingPairOfEyesSortsNothingAndEyesInOneCellShare) {
    const CellBuffers cells = showing(gl_, cell_set({{0, 0, 3}, {1, 2, 3}, {1, 2, 7}}));
    const View left = view_;
    View right = view_;
    right.eye_from_room = glm::translate(glm::mat4(1.0f), glm::vec3(-1.2f, 0, 0));
    for (int frame = 0; frame < 5; ++frame) {
        pass_.draw(left, placement_, cells, Footprint::gaussian);
        pass_.draw(right, placement_, cells, Footprint::gaussian);
    }
    EXPECT_EQ(pass_.orders().sorts(), 2u);
    right.eye_from_room = glm::translate(glm::mat4(1.0f), glm::vec3(-0.06f, 0, 0));
    pass_.draw(right, placement_, cells, Footprint::gaussian);
    EXPECT_EQ(pass_.orders().sorts(), 2u);
}

TEST_P(CellPasses, ANewSetIsSortedAnew) {
    const index::TestField field({41, 41, 41}, 1, index::ValueType::u8, index::moving_sphere);
    Extractions extractions(field.view());
    CellBuffers cells(gl_, field.view().grid);
    for (const double isovalue : {100.0, 120.0}) {
        cells.upload(extractions.active(0, {isovalue}), 1 << 20);
        draw(cells, Footprint::gaussian);
        draw(cells, Footprint::gaussian);
    }
    EXPECT_EQ(pass_.orders().sorts(), 2u);
}

TEST_P(CellPasses, NothingIsDrawnWithoutASetOrFromAnEmptyOne) {
    const CellBuffers none(gl_, {.vertices = {41, 41, 41}});
    const CellBuffers empty = showing(gl_, {});
    for (const CellBuffers* cells : {&none, &empty}) {
        draw(*cells, Footprint::gaussian);
        draw(*cells, Footprint::quad);
    }
    for (const std::uint8_t value : target_.read().rgba)
        ASSERT_EQ(value, 0);
}

TEST_P(CellPasses, TwoViewsInOnePassLookAsInTwo) {
    // Another program, another viewport: a blended value may be rounded the other way.
    const auto nearly_equal = [](int a, int b) { return std::abs(a - b) <= 1; };
    ASSERT_EQ(pass_.draws_two_views_at_once(), draws_to_two_viewports(gl_));
    CellPass apart(gl_, {.shape = CellShape::voxel});
    apart.draw_views_apart();
    std::vector<glm::ivec3> cells;
    for (int i = 0; i < 300; ++i)
        cells.emplace_back(random_() % 12, random_() % 12, random_() % 30);
    std::array<View, 2> views{view_, view_};
    views[0].eye_from_room = glm::translate(glm::mat4(1.0f), glm::vec3(-2.0f, -3.0f, 0.0f));
    views[1].eye_from_room = glm::translate(glm::mat4(1.0f), glm::vec3(-9.0f, -5.0f, 3.0f));
    views[1].size = {kSize - 30, kSize - 7}; // side by side in one target, of two sizes
    views[1].corner = {kSize, 5};
    RenderTarget both(gl_, {2 * kSize, kSize});
    const CellBuffers buffers = showing(gl_, cell_set(cells, packed_normal(kFacing)));
    for (const Footprint footprint : {Footprint::quad, Footprint::gaussian}) {
        std::array<Image, 2> images;
        for (const bool at_once : {false, true}) {
            both.bind();
            both.clear({0, 0, 0, 0});
            (at_once ? pass_ : apart).draw(views, placement_, buffers, footprint, appearance_);
            images[at_once] = both.read();
        }
        EXPECT_TRUE(std::equal(images[0].rgba.begin(), images[0].rgba.end(), images[1].rgba.begin(),
                               nearly_equal));
        for (const View& view : views) {
            RenderTarget alone(gl_, view.size);
            alone.bind();
            alone.clear({0, 0, 0, 0});
            View moved = view;
            moved.corner = {0, 0};
            pass_.draw(moved, placement_, buffers, footprint, appearance_);
            const Image expected = alone.read();
            int covered = 0;
            for (int y = 0; y < view.size.y; ++y)
                for (int x = 0; x < view.size.x; ++x) {
                    const std::uint8_t* pixel = expected.at(x, y);
                    const std::uint8_t* same =
                        images[1].at(view.corner.x + x, kSize - view.corner.y - view.size.y + y);
                    covered += pixel[3] > 0;
                    ASSERT_TRUE(std::equal(pixel, pixel + 4, same, nearly_equal)) << x << ' ' << y;
                }
            EXPECT_GT(covered, 100);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(, CellPasses, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
