// Points and quads show the same, and points are used only where they are valid.
#include "render/cells/point_sprites.h"

#include "render/drawing/cell_pass.h"
#include "render/gl/render_target.h"
#include "tests/render/cells/outline_oracle.h"
#include "tests/render/cells/random_views.h"
#include "tests/support/drawing/gl_test.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cstdlib>

namespace isochron::render {
namespace {

constexpr float kLargest = 255.0f;
constexpr double kPointRadius = 0.5 * double(FootprintShapes{}.quad_diameter);

/// A view of a whole volume, from outside, from within or past it; now and then parallel.
Scene random_scene(std::mt19937& random) {
    auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    Scene scene;
    scene.view.size = {uniform(100, 400), uniform(100, 400)};
    const glm::dvec3 extent(std::floor(uniform(2, 40)), std::floor(uniform(2, 40)),
                            std::floor(uniform(2, 40)));
    const glm::dvec3 spacing(uniform(1, 1.8), uniform(1, 1.8), uniform(1, 1.8));
    const double radius = 0.5 * glm::length(extent * spacing);
    const glm::dvec3 axis = glm::normalize(
        glm::dvec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)) + glm::dvec3(0.01));
    scene.placement.extent = glm::vec3(extent);
    scene.placement.room_from_index =
        glm::mat4(glm::translate(glm::dmat4(1.0), glm::dvec3(uniform(-0.3, 0.3), uniform(-0.3, 0.3),
                                                             -uniform(0.5, 4.0))) *
                  glm::rotate(glm::dmat4(1.0), uniform(0, 6), axis) *
                  glm::scale(glm::dmat4(1.0), spacing / radius) *
                  glm::translate(glm::dmat4(1.0), -0.5 * extent));
    const double right = uniform(0.02, 0.06), left = -uniform(0.02, 0.06),
                 top = uniform(0.02, 0.06), bottom = -uniform(0.02, 0.06);
    scene.view.clip_from_eye =
        random() % 4 ? glm::mat4(glm::frustum(left, right, bottom, top, 0.05, 20.0))
                     : glm::mat4(glm::ortho(40 * left, 40 * right, 40 * bottom, 40 * top, -9., 9.));
    return scene;
}

TEST(PointSprites, ServeOnlyWhereNoFootprintCrossesAnEdgeOrIsTooLarge) {
    std::mt19937 random(test_seed());
    int served = 0, refused = 0;
    for (int round = 0; round < 2000; ++round) {
        Scene scene = random_scene(random);
        const double radius = round % 2 ? kPointRadius : 2.0;
        const bool rectangle = round % 2;
        if (!points_serve(scene.view, scene.placement, static_cast<float>(radius),
                          rectangle ? kReachOfRectangle : 1.0f, kLargest)) {
            ++refused;
            continue;
        }
        ++served;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 last = glm::dvec3(scene.placement.extent) - 1.0;
            const glm::dvec3 cell = last * glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2);
            const Ellipse ellipse = paper_ellipse(scene.pixel_from_index(), cell + 0.5, radius);
            const glm::dvec2 half = 0.5 * glm::dvec2(scene.view.size);
            // Half sides of the upright box around the rectangle, or around the ellipse.
            const glm::dvec2 a = glm::abs(ellipse.major), b = glm::abs(ellipse.minor);
            const glm::dvec2 reach = rectangle ? a + b : glm::sqrt(a * a + b * b);
            for (const glm::dvec2& at : {ellipse.center + reach, ellipse.center - reach}) {
                ASSERT_LE(std::abs(at.x), half.x + 0.5) << "round " << round;
                ASSERT_LE(std::abs(at.y), half.y + 0.5) << "round " << round;
            }
            ASSERT_LE(2 * glm::length(ellipse.major), double(kLargest)) << "round " << round;
        }
    }
    EXPECT_GT(served, 200);
    EXPECT_GT(refused, 200);
}

TEST(PointSprites, DoNotServeFlatCells) {
    Scene scene;
    scene.view.size = {200, 200};
    scene.view.clip_from_eye = glm::ortho(-30.0f, 30.0f, -30.0f, 30.0f, -100.0f, 100.0f);
    scene.placement.extent = glm::vec3(10.0f);
    EXPECT_TRUE(points_serve(scene.view, scene.placement, 2.0f, kReachOfRectangle, kLargest));
    EXPECT_FALSE(points_serve(scene.view, scene.placement, 2.0f, 1.0f, 5.0f));
    scene.placement.room_from_index = glm::scale(glm::mat4(1.0f), glm::vec3(1.0f, 1.0f, 2.5f));
    EXPECT_FALSE(points_serve(scene.view, scene.placement, 2.0f, kReachOfRectangle, kLargest));
}

TEST(PointSprites, AreWholeFootprintsOnlyWhereTheseAreNearlySquares) {
    std::mt19937 random(test_seed());
    int square = 0, other = 0;
    for (int round = 0; round < 4000; ++round) {
        Scene scene = random_scene(random);
        if (round % 4) { // cubes, mostly
            glm::mat4& room = scene.placement.room_from_index;
            for (int axis = 1; axis < 3; ++axis)
                room[axis] *= glm::length(room[0]) / glm::length(room[axis]);
            const double aspect = double(scene.view.size.y) * scene.view.clip_from_eye[1][1] /
                                  (double(scene.view.size.x) * scene.view.clip_from_eye[0][0]);
            scene.view.size.y = std::max(1, int(std::lround(scene.view.size.y / aspect)));
        }
        const auto radius = float(kPointRadius);
        if (!points_serve(scene.view, scene.placement, radius, kReachOfRectangle, kLargest))
            continue;
        double most = 0; // pixels between a half side of the square and the ellipse's half axes
        for (int cell = 0; cell < 60; ++cell) {
            glm::dvec3 at(0.5);
            for (int axis = 0; axis < 3; ++axis)
                at[axis] += int(random() % unsigned(scene.placement.extent[axis]));
            const Ellipse ellipse = paper_ellipse(scene.pixel_from_index(), at, kPointRadius);
            const glm::dvec2 a = ellipse.major, b = ellipse.minor;
            const double half = std::sqrt(std::max(a.x * a.x + b.x * b.x, a.y * a.y + b.y * b.y));
            most = std::max({most, glm::length(a) - half, half - glm::length(b)});
        }
        const bool squares = footprints_are_squares(scene.view, scene.placement, radius);
        if (squares) {
            ASSERT_LE(most, 0.8) << "round " << round;
        }
        square += squares;
        other += !squares;
    }
    EXPECT_GT(square, 100);
    EXPECT_GT(other, 100);
}

class PointPasses : public GlTest {
  protected:
    /// Whether the picture has that color at (x, y) or in one of the eight pixels around it.
    static bool shown_beside(const Image& image, const std::uint8_t* color, int x, int y) {
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, image.height - 1); ++v)
            for (int u = std::max(x - 1, 0); u <= std::min(x + 1, image.width - 1); ++u)
                if (std::equal(color, color + 4, image.at(u, v),
                               [](int a, int b) { return std::abs(a - b) <= 4; }))
                    return true;
        return false;
    }
};

TEST_P(PointPasses, ShowWhatQuadsShow) {
    for (const CellShape shape : {CellShape::plane, CellShape::voxel}) {
        CellPass as_points(gl_, {.shape = shape}), as_quads(gl_, {.shape = shape});
        as_quads.draw_without_points();
        int compared = 0;
        for (int round = 0; compared < 12; ++round) {
            ASSERT_LT(round, 1000);
            const Scene scene = random_scene(random_);
            if (!points_serve(scene.view, scene.placement, 2.0f, kReachOfRectangle, kLargest))
                continue;
            ++compared;
            const glm::ivec3 last = glm::ivec3(scene.placement.extent) - 1;
            std::vector<glm::ivec3> cells;
            for (int i = 0; i < 12; ++i)
                cells.push_back(glm::ivec3(random_() % (last.x + 1), random_() % (last.y + 1),
                                           random_() % (last.z + 1)));
            const CellBuffers buffers =
                showing(gl_, cell_set(cells, packed_normal({0.6f, 0, 0.8f})));
            RenderTarget target(gl_, scene.view.size);
            for (const Footprint footprint : {Footprint::quad, Footprint::gaussian}) {
                std::array<Image, 2> images;
                for (CellPass* pass : {&as_points, &as_quads}) {
                    target.bind();
                    target.clear({0, 0, 0, 0});
                    pass->draw(scene.view, scene.placement, buffers, footprint);
                    images[pass == &as_quads] = target.read();
                }
                // Edges may lie on the other side of pixels' middles: what is shown beside them
                // then.
                int different = 0, drawn = 0;
                for (int y = 0; y < images[0].height; ++y)
                    for (int x = 0; x < images[0].width; ++x) {
                        different += !shown_beside(images[1], images[0].at(x, y), x, y) ||
                                     !shown_beside(images[0], images[1].at(x, y), x, y);
                        drawn += images[1].at(x, y)[3] > 0;
                    }
                EXPECT_GT(drawn, 10);
                EXPECT_LE(different, 2 + drawn / 1000) << "round " << round;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(, PointPasses, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
