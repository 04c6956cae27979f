// The oracle itself: its ellipse is the outline of the points of the sphere.
#include "tests/render/cells/outline_oracle.h"
#include "tests/render/cells/random_views.h"
#include "tests/support/test_seed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace isochron::render {
namespace {

TEST(OutlineOracle, PointsOfTheSphereFillTheEllipseAndNoMore) {
    std::mt19937 random(test_seed());
    std::normal_distribution<double> normal;
    for (int round = 0; round < 60; ++round) {
        const Scene scene = random_scene(random);
        const glm::dmat4 m = scene.pixel_from_index();
        const glm::dvec3 center = glm::dvec3(scene.cell) + 0.5;
        const Ellipse ellipse = paper_ellipse(m, center, scene.radius);
        double farthest = 0.0;
        for (int i = 0; i < 20000; ++i) {
            const glm::dvec3 n =
                glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
            const glm::dvec4 at = m * glm::dvec4(center + n * scene.radius, 1.0);
            farthest = std::max(farthest, ellipse.distance(glm::dvec2(at) / at.w));
        }
        EXPECT_LE(farthest, 1.0 + 1e-6);
        EXPECT_GT(farthest, 0.99);
    }
}

} // namespace
} // namespace isochron::render
