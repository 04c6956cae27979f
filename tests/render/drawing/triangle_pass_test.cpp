// Triangles beside the cells: where they are drawn, what hides and cuts them, and in which colors.
#include "render/drawing/triangle_pass.h"
#include "render/gl/render_target.h"
#include "render/gl/srgb.h"
#include "tests/render/drawing/flat_view.h"
#include "tests/support/drawing/gl_test.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace isochron::render {
namespace {

constexpr int kPlatePixels =
    100; ///< [pixel] of a picture of 10 x 10 units, seen along -z from z = 20
constexpr glm::dvec3 kFarOrigin(4e6, -3e6, 2e5);

/// Two triangles over [x0, x1] x [y0, y1] at a height z.
index::TriangleMeshPtr plate(float x0, float x1, float y0, float y1, float z,
                             const glm::dvec3& origin = glm::dvec3(0.0)) {
    return std::make_shared<index::TriangleMesh>(
        index::TriangleMesh{.origin = origin,
                            .points = {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}},
                            .normals = {},
                            .corners = {0, 1, 2, 0, 2, 3}});
}

class TrianglePassTest : public GlTest {
  protected:
    struct Drawn {
        index::TriangleMeshPtr mesh;
        TriangleLook look;
    };
    /// Draws in this order. All light is ambient, so that colors are those of the looks.
    Image draw(const std::vector<Drawn>& all, const std::vector<glm::vec4>& cuts = {},
               const glm::dvec3& origin = glm::dvec3(0.0),
               TriangleShare share = TriangleShare::all) {
        const index::Grid grid{.vertices = {11, 11, 11}, .origin = origin};
        const Placement placement =
            Placement::of(grid, glm::translate(glm::dmat4(1.0), -origin)); // the data's corner: 0
        const View view = flat_view(kPlatePixels);
        const CellAppearance look = flat_light(cuts);
        TrianglePass pass(gl_, grid);
        std::vector<index::TriangleMeshPtr> held;
        for (const Drawn& each : all)
            held.push_back(each.mesh);
        pass.hold(held);
        target_.bind();
        target_.clear({0, 0, 0, 1});
        for (const Drawn& each : all)
            pass.draw(view, placement, *each.mesh, each.look, look, share);
        return target_.read();
    }
    /// The linear light of the pixel at a place, 0 to 1.
    static glm::vec3 light(const Image& image, double x, double y) {
        const auto* at =
            image.at(static_cast<int>(10 * x), kPlatePixels - 1 - static_cast<int>(10 * y));
        glm::vec3 srgb(at[0], at[1], at[2]);
        return linear_from_srgb(srgb / 255.0f);
    }
    RenderTarget target_{gl_, {kPlatePixels, kPlatePixels}};
};

constexpr glm::vec3 kPlateRed(1, 0, 0), kPlateGreen(0, 1, 0);

TEST_P(TrianglePassTest, LieWhereTheyAreAlsoFarFromZero) {
    for (const glm::dvec3& origin : {glm::dvec3(0.0), kFarOrigin}) {
        const Image image = draw({{plate(2, 5, 1, 9, 3, origin), {kPlateRed}}}, {}, origin);
        int wrong = 0;
        for (int y = 0; y < kPlatePixels; ++y)
            for (int x = 0; x < kPlatePixels; ++x) {
                const bool inside = x >= 20 && x < 50 && y >= 10 && y < 90;
                wrong += (light(image, (x + 0.5) / 10, (y + 0.5) / 10).x > 0.5) != inside;
            }
        EXPECT_EQ(wrong, 0);
    }
}

TEST_P(TrianglePassTest, HideWhatLiesBehindInAnyOrder) {
    const Drawn near{plate(2, 8, 2, 8, 6), {kPlateRed}}, far{plate(0, 10, 4, 6, 3), {kPlateGreen}};
    for (const bool near_first : {false, true}) {
        const Image image = draw(near_first ? std::vector{near, far} : std::vector{far, near});
        EXPECT_NEAR(light(image, 5, 5).x, 1, 0.02);
        EXPECT_NEAR(light(image, 5, 5).y, 0, 0.02);
        EXPECT_NEAR(light(image, 1, 5).y, 1, 0.02);
    }
}

TEST_P(TrianglePassTest, LetTheShareOfLightThroughThatTheyDoNotCover) {
    const Image image =
        draw({{plate(0, 10, 0, 10, 3), {kPlateGreen}}, {plate(2, 8, 2, 8, 6), {kPlateRed, 0.25f}}});
    EXPECT_NEAR(light(image, 5, 5).x, 0.25, 0.02);
    EXPECT_NEAR(light(image, 5, 5).y, 0.75, 0.02);
}

/// What lies beyond the middle of the volume, z = 5, comes before the cells, all else after them.
TEST_P(TrianglePassTest, DivideIntoSharesAtTheMiddleOfTheVolume) {
    auto both = std::make_shared<index::TriangleMesh>(*plate(0, 10, 0, 5, 8));
    const auto beyond = plate(0, 10, 5, 10, 2);
    both->points.insert(both->points.end(), beyond->points.begin(), beyond->points.end());
    for (const std::uint32_t corner : {4u, 5u, 6u, 4u, 6u, 7u})
        both->corners.push_back(corner);
    const auto shown = [&](TriangleShare share, double y) {
        return light(draw({{both, {kPlateRed, 0.5f}}}, {}, glm::dvec3(0.0), share), 5, y).x > 0.4;
    };
    EXPECT_TRUE(shown(TriangleShare::all, 2) && shown(TriangleShare::all, 8));
    EXPECT_TRUE(shown(TriangleShare::before, 2) && !shown(TriangleShare::before, 8));
    EXPECT_FALSE(shown(TriangleShare::beyond, 2));
    EXPECT_TRUE(shown(TriangleShare::beyond, 8));
}

TEST_P(TrianglePassTest, AreCutByEveryPlane) {
    const Image image = draw({{plate(0, 10, 0, 10, 3), {kPlateRed}}},
                             {glm::vec4(1, 0, 0, -6), glm::vec4(0, -1, 0, 2)}); // x > 6, y < 2
    EXPECT_NEAR(light(image, 5.8, 5).x, 1, 0.02);
    EXPECT_NEAR(light(image, 6.2, 5).x, 0, 0.02);
    EXPECT_NEAR(light(image, 5, 2.2).x, 1, 0.02);
    EXPECT_NEAR(light(image, 5, 1.8).x, 0, 0.02);
}

TEST_P(TrianglePassTest, HaveEdgesOnlyAsLines) {
    const Image image = draw({{plate(2, 8, 2, 8, 3), {.color = kPlateRed, .lines = true}}});
    int red = 0;
    for (int i = 0; i < kPlatePixels; ++i)
        red += light(image, (i + 0.5) / 10, 3.05).x > 0.5; // two sides and the diagonal
    EXPECT_GE(red, 2);
    EXPECT_LE(red, 6);
    EXPECT_NEAR(light(image, 6.5, 3.5).x, 0, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Contexts, TrianglePassTest, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
