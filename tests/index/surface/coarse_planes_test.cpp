// Planes of coarse levels: where the volume's surface is, and as cells beside each other say.
#include "index/surface/coarse_planes.h"

#include "index/indexing/index_build.h"
#include "index/search/layer_search.h"
#include "index/surface/cell_plane.h"
#include "tests/support/memory_series.h"
#include "tests/support/test_folder.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace isochron::index {
namespace {

constexpr double kRadius = 20;
const glm::dvec3 kMiddle(32.3, 31.8, 32.1);

/// Cells of a level of a ball; `side` is 1, or -1 for a hollow.
std::vector<CellPoint> cells_of_ball(unsigned level, double side) {
    const TestField field({65, 65, 65}, 1, ValueType::f32,
                          [side](double x, double y, double z, double) {
                              return side * (kRadius - glm::length(glm::dvec3(x, y, z) - kMiddle));
                          });
    const test_support::TestFolder folder;
    MemorySeries series(field.view());
    build_index(series, folder.path() / "a.isochron", {.tiers = TierSet().with(Tier::bricks)});
    CellSet set;
    set.query = {Instant(0), 0.0};
    const auto file = IndexFile::open(folder.path() / "a.isochron", 1);
    EXPECT_TRUE(
        LayerSearch(file).search(step_in_chunks(*file, Instant(0), level), set, true, true, {}));
    return set.points;
}

/// Mean distance of planes from the ball, outside of which it is positive [voxels of the level].
double outside(const std::vector<CellPoint>& points, unsigned level, double side) {
    const double voxel = std::exp2(level);
    double sum = 0;
    for (const CellPoint& point : points) {
        const CellPlane plane = unpack_plane(point.plane);
        const glm::dvec3 at =
            voxel * (glm::dvec3(point.x, point.y, point.z) + 0.5 + plane.offset * plane.normal);
        sum += (glm::length(at - kMiddle) - kRadius) / voxel;
        EXPECT_GT(side * glm::dot(plane.normal, at - kMiddle), 0);
    }
    return sum / static_cast<double>(points.size());
}

TEST(CoarsePlanes, LieOnTheVolumesSurfaceNotInsideOfWhatBendsAwayFromIt) {
    for (const double side : {1.0, -1.0})
        for (const unsigned level : {1u, 2u}) {
            SCOPED_TRACE(testing::Message() << "side " << side << " level " << level);
            std::vector<CellPoint> points = cells_of_ball(level, side);
            ASSERT_GT(points.size(), 100u);
            const double before = outside(points, level, side);
            move_planes_out(points, glm::dvec3(1.0));
            const double after = outside(points, level, side);
            EXPECT_LT(before, -0.015 * std::exp2(level)) << "the means make it smaller";
            EXPECT_LT(std::abs(after), 0.4 * std::abs(before));
        }
}

TEST(CoarsePlanes, MoveByASixthOfHowNormalsOfCellsBesideDiffer) {
    std::vector<CellPoint> points = cells_of_ball(1, 1.0), moved = points;
    const glm::dvec3 spacing(1.0, 2.0, 0.7);
    move_planes_out(moved, spacing);
    std::map<std::array<int, 3>, glm::vec3> normals;
    for (const CellPoint& p : points)
        normals[{p.x, p.y, p.z}] =
            glm::normalize(glm::vec3(spacing * unpack_plane(p.plane).normal));
    int in_the_middle = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::array<int, 3> at{points[i].x, points[i].y, points[i].z};
        double bend = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            double sum = 0;
            int beside = 0;
            for (const int to : {-1, 1}) {
                std::array<int, 3> other = at;
                other[axis] += to;
                const auto found = normals.find(other);
                if (found == normals.end() || other[axis] / 16 != at[axis] / 16)
                    continue;
                sum += to * double(found->second[int(axis)] - normals[at][int(axis)]);
                ++beside;
            }
            bend += beside > 0 ? sum / beside : 0.0;
        }
        const double wanted =
            unpack_plane(points[i].plane).offset + std::clamp(bend / 6, -0.25, 0.25);
        EXPECT_NEAR(unpack_plane(moved[i].plane).offset, std::min(wanted, CellPlane::kFarthest),
                    0.004)
            << i;
        in_the_middle += std::abs(bend) > 0.02;
    }
    EXPECT_GT(in_the_middle, 100);
}

TEST(CoarsePlanes, WithoutANormalStayAsTheyAre) {
    std::vector<CellPoint> points{
        {1, 1, 1, 0, 0}, {2, 1, 1, 0, pack({{1, 0, 0}, 0.1})}, {3, 1, 1, 0, 0}};
    const auto before = points[1].plane;
    move_planes_out(points, glm::dvec3(1.0));
    EXPECT_EQ(points[0].plane, 0u);
    EXPECT_EQ(points[1].plane, before) << "nothing beside it has a normal";
    std::vector<CellPoint> none;
    move_planes_out(none, glm::dvec3(1.0));
}

} // namespace
} // namespace isochron::index
