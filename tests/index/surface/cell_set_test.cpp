// Positions and normals of active cells against analytic fields and a slow oracle.
#include "index/scan/scan.h"
#include "index/search/id_sort.h"
#include "index/surface/cell_set.h"
#include "tests/support/simd_targets.h"
#include "tests/support/test_field.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace isochron::index {
namespace {

/// Three unit axes, turned out of the coordinate axes, mirrored if asked.
glm::dmat3 turned(bool mirrored) {
    glm::dmat3 m(glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1, 2, -0.5))));
    if (mirrored)
        m[2] = -m[2];
    return m;
}

StepValues placed(StepValues values, const glm::dvec3& spacing, const glm::dmat3& direction) {
    values.grid.spacing = spacing;
    values.grid.direction = direction;
    values.grid.origin = {5, -3, 11};
    return values;
}

/// The definition, vertex by vertex: the mean of eight gradients, each by central differences, or
/// one-sided ones at the border.
glm::dvec3 slow_normal(const StepValues& values, std::size_t step, CellId id) {
    const Grid& grid = values.grid;
    const auto cell = grid.cell_of(id);
    const auto value = [&](std::array<std::uint32_t, 3> v) {
        return scaled_value(
            values, step, (std::size_t{v[2]} * grid.vertices[1] + v[1]) * grid.vertices[0] + v[0]);
    };
    glm::dvec3 mean(0.0);
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
        const std::array<std::uint32_t, 3> v{cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1),
                                             cell[2] + (corner >> 2)};
        glm::dvec3 by_index;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            auto low = v, high = v;
            if (low[axis] > 0)
                --low[axis];
            if (high[axis] + 1 < grid.vertices[axis])
                ++high[axis];
            by_index[int(axis)] = (value(high) - value(low)) / double(high[axis] - low[axis]);
        }
        // d value = gradient . d position, and position = direction * (spacing * index).
        glm::dmat3 position_by_index;
        for (int axis = 0; axis < 3; ++axis)
            position_by_index[axis] = grid.direction[axis] * grid.spacing[axis];
        mean += by_index * glm::inverse(position_by_index) / 8.0; // row vector times matrix
    }
    const double length = glm::length(mean);
    return length > 0 && std::isfinite(length) ? -mean / length : glm::dvec3(0.0);
}

glm::dvec3 unpacked(std::uint32_t plane) {
    return unpack_plane(plane).normal;
}

/// Where a normal lies on the octahedron that it is packed by, in its steps.
glm::dvec2 on_octahedron(const glm::dvec3& n) {
    const double sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    glm::dvec2 at = glm::dvec2(n) / sum;
    if (n.z < 0)
        at = {(1 - std::abs(n.y) / sum) * (n.x < 0 ? -1 : 1),
              (1 - std::abs(n.x) / sum) * (n.y < 0 ? -1 : 1)};
    return 2047.0 * at;
}

CellSet all_cells(const StepValues& values, std::uint32_t step, double isovalue = 0.0) {
    CellSet set;
    set.query = {Instant(step), isovalue};
    set.ids.resize(values.grid.cell_count());
    std::iota(set.ids.begin(), set.ids.end(), CellId{0});
    EXPECT_TRUE(shade_cells(values, set));
    return set;
}

TEST(CellSet, NormalsAreTheMeanOfEightCentralDifferencesForEveryTypeAndPlacement) {
    const std::uint32_t seed = test_seed();
    std::mt19937 random(seed);
    for (const ValueType type : kAllTypes)
        for (const double slope : {1.0, -0.25}) {
            const TestField field({5, 4, 6}, 2, type, scaled(white_noise(random), 50, 60),
                                  {slope, 3.0});
            const StepValues values = placed(field.view(), {0.5, 2.0, 1.25}, turned(slope < 0));
            const CellSet set = all_cells(values, 1);
            for (const CellId id : set.ids) {
                const glm::dvec3 expected = slow_normal(values, 1, id);
                EXPECT_LT(glm::distance(cell_normal(values, 1, id), expected), 1e-9)
                    << name_of(type) << " cell " << id;
                EXPECT_LT(glm::distance(unpacked(set.points[id].plane), expected), 0.002);
            }
        }
}

/// How far rounding takes a normal at most: in the middle of the octahedron's faces, at 1/sqrt(3),
/// by half a step along u and along v, and so by a whole one along the third axis.
const double kFarthestRounded = 1.001 * (0.5 / 2047) * std::sqrt(6.0) * std::sqrt(3.0);

/// Every packed component is the exact one rounded: off by more than half a unit only as far as
/// rounding before the rounding may take it across a tie.
void expect_packed_exactly(const StepValues& values, std::uint32_t step) {
    on_every_simd_target([&] {
        const CellSet set = all_cells(values, step);
        for (const CellId id : set.ids) {
            const std::uint32_t word = set.points[id].plane;
            const glm::dvec3 normal = cell_normal(values, step, id);
            ASSERT_EQ((word & kNormalBits) == 0, normal == glm::dvec3(0.0)) << "cell " << id;
            if (normal == glm::dvec3(0.0))
                continue;
            // At the seams of the fold either side is right.
            const auto small = [](double c) { return std::abs(c) < 1e-6; };
            if (small(normal.z) || (normal.z < 0 && (small(normal.x) || small(normal.y)))) {
                ASSERT_LT(glm::distance(unpacked(word), normal), kFarthestRounded) << "cell " << id;
                continue;
            }
            const glm::dvec2 exact = on_octahedron(normal);
            ASSERT_NEAR(int(word & 0xfff) - 2048, exact.x, 0.501) << "cell " << id;
            ASSERT_NEAR(int(word >> 12 & 0xfff) - 2048, exact.y, 0.501) << "cell " << id;
        }
    });
}

TEST(CellSet, PackedNormalsAreTheExactOnesRoundedForEveryTypeAndItsExtremes) {
    std::mt19937 random(test_seed());
    for (const ValueType type : kAllTypes)
        for (const double range : {1.0, 100.0, 4e9}) { // clamped: mostly the type's extremes
            SCOPED_TRACE(testing::Message() << name_of(type) << ' ' << range);
            const TestField field({23, 9, 8}, 2, type, scaled(white_noise(random), range, 0));
            expect_packed_exactly(field.view(), 1);
            expect_packed_exactly(placed(field.view(), {0.5, 2.0, 1.25}, turned(true)), 0);
        }
}

TEST(CellSet, PlanesLieWhereTheMeanValueReachesTheIsovalueForEveryTypeAndBorder) {
    std::mt19937 random(test_seed());
    std::size_t beside = 0;
    for (const ValueType type : kAllTypes)
        for (const double slope : {1.0, -0.25}) {
            SCOPED_TRACE(testing::Message() << name_of(type) << ' ' << slope);
            const TestField field({23, 9, 8}, 2, type, scaled(turbulence(random), 60, 10),
                                  {slope, 3.0});
            const StepValues values = placed(field.view(), {0.5, 2.0, 1.25}, turned(slope < 0));
            const auto isovalues = quantiles(sorted_values(values), 2);
            for (const double isovalue : isovalues)
                on_every_simd_target([&] {
                    const CellSet set = all_cells(values, 1, isovalue);
                    for (const CellId id : set.ids) {
                        const CellPlane plane = cell_plane(values, set.query, id);
                        const double step = CellPlane::kFarthest / packed_plane::kFarthest;
                        const double packed = unpack_plane(set.points[id].plane).offset;
                        if (plane.normal == glm::dvec3(0.0))
                            continue;
                        ASSERT_NEAR(packed / step, plane.offset / step, 0.51) << "cell " << id;
                        beside += std::abs(plane.offset) > 0.1 && std::abs(plane.offset) < 0.8;
                    }
                });
        }
    EXPECT_GT(beside, 5000u);
}

TEST(CellSet, APlaneThroughALinearRampIsTheRampsOwn) {
    // Slopes along one axis: the offset is where the isovalue lies between the two vertices.
    for (const double at : {0.1, 0.5, 0.77}) {
        const TestField ramp({6, 6, 6}, 1, ValueType::f32,
                             [](double x, double, double, double) { return 10 * x; });
        const CellSet set = all_cells(ramp.view(), 0, 10 * (2 + at));
        const auto of = [&](std::size_t x) {
            return unpack_plane(set.points[(1 * 5 + 2) * 5 + x].plane);
        };
        EXPECT_LT(glm::distance(of(2).normal, {-1, 0, 0}), 1e-3);
        EXPECT_NEAR(of(2).offset, 0.5 - at, 0.004); // towards lower values
        EXPECT_NEAR(of(4).offset, CellPlane::kFarthest, 0.004) << "beyond the cell";
    }
}

TEST(CellSet, PlanesGoThroughTheirWordsToWithinAStep) {
    std::mt19937 random(test_seed());
    std::uniform_real_distribution<double> any(-1, 1);
    for (int round = 0; round < 10000; ++round) {
        const glm::dvec3 normal = glm::normalize(glm::dvec3(any(random), any(random), any(random)));
        const double offset = CellPlane::kFarthest * any(random);
        const CellPlane read = unpack_plane(pack({normal, offset}));
        ASSERT_LT(glm::distance(read.normal, normal), kFarthestRounded);
        ASSERT_NEAR(read.offset, offset, 0.0035);
        ASSERT_NE(pack({normal, offset}) & kNormalBits, 0u);
    }
    EXPECT_EQ(pack({glm::dvec3(0.0), 0.5}), 0u);
}

TEST(CellSet, PackedNormalsAreExactWhereSpacingsDifferByFarMoreThanFloatHasDigits) {
    std::mt19937 random(test_seed());
    for (const double small : {1e-3, 1e-5, 1e-30, 1e-150}) {
        SCOPED_TRACE(small);
        const TestField field({12, 7, 7}, 1, ValueType::u8,
                              [&](double x, double, double z, double) {
                                  return std::floor(x / 3) + (random() % 2 ? z : 0);
                              });
        expect_packed_exactly(placed(field.view(), {1.0, small, 1.0}, turned(false)), 0);
        expect_packed_exactly(placed(field.view(), {1.0, 1.0, 1.0 / small}, turned(false)), 0);
    }
}

TEST(CellSet, PackedNormalsAreExactAtTheLimitsOfFloatingPoint) {
    std::mt19937 random(test_seed());
    for (const double factor : {1e-310, 1e-45, 1e38, 1e300})
        for (const ValueType type : {ValueType::f32, ValueType::f64}) {
            SCOPED_TRACE(testing::Message() << name_of(type) << ' ' << factor);
            const TestField field({9, 8, 7}, 1, type, scaled(white_noise(random), factor * 3, 0));
            expect_packed_exactly(field.view(), 0);
        }
}

TEST(CellSet, PackedNormalsAreZeroExactlyWhereThereIsNoNormal) {
    std::mt19937 random(test_seed());
    const TestField::Function noise = white_noise(random);
    const TestField field(
        {30, 9, 8}, 1, ValueType::f32, [&](double x, double y, double z, double t) {
            constexpr std::array kSpecial{double(NAN), double(INFINITY), -double(INFINITY), 0.0};
            return random() % 100 < 8 ? kSpecial[random() % 4] : x < 12 ? 1.0 : noise(x, y, z, t);
        });
    on_every_simd_target([&] {
        const CellSet set = all_cells(field.view(), 0);
        for (const CellId id : set.ids)
            ASSERT_EQ(set.points[id].plane == 0,
                      cell_normal(field.view(), 0, id) == glm::dvec3(0.0))
                << "cell " << id;
    });
}

TEST(CellSet, ALinearRampHasTheSameNormalEverywhereAlsoWhenTurnedAndStretched) {
    const glm::dvec3 gradient(0.3, -1.2, 0.8); // in physical space
    for (const bool mirrored : {false, true}) {
        Grid grid{.vertices = {4, 5, 2},
                  .origin = {5, -3, 11},
                  .spacing = {0.2, 3.0, 1.0},
                  .direction = turned(mirrored)};
        const glm::dmat4 physical = grid.physical_from_index();
        const TestField field(
            grid.vertices, 1, ValueType::f64, [&](double x, double y, double z, double) {
                return glm::dot(gradient, glm::dvec3(physical * glm::dvec4(x, y, z, 1)));
            });
        const StepValues values = placed(field.view(), grid.spacing, grid.direction);
        for (CellId id = 0; id < grid.cell_count(); ++id)
            EXPECT_LT(glm::distance(cell_normal(values, 0, id), -glm::normalize(gradient)), 1e-9);
    }
}

TEST(CellSet, NormalsOfASphereThatIsBrightInsidePointOutwards) {
    const TestField field({40, 40, 40}, 1, ValueType::f32, moving_sphere);
    const StepValues values = field.view();
    CellSet set;
    set.query = {Instant(0), 112.5};
    scan(values, set.query, set.ids);
    ASSERT_GT(set.ids.size(), 1000u);
    ASSERT_TRUE(shade_cells(values, set));
    for (const CellPoint& point : set.points) {
        const glm::dvec3 outwards = glm::normalize(
            glm::dvec3(point.x + 0.5, point.y + 0.5, point.z + 0.5) - glm::dvec3(22, 19, 22));
        EXPECT_GT(glm::dot(glm::normalize(unpacked(point.plane)), outwards), 0.9999);
        EXPECT_EQ(point.style, 0);
    }
}

TEST(CellSet, ANormalNeedsFiniteNeighborsAndAGradient) {
    TestField flat({6, 6, 6}, 1, ValueType::f32, [](double, double, double, double) { return 4; });
    for (const CellPoint& point : all_cells(flat.view(), 0).points)
        EXPECT_EQ(point.plane, 0u);
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        TestField ramp({6, 6, 6}, 1, ValueType::f32,
                       [](double x, double, double, double) { return x; });
        ramp.at<float>(0, (2 * 6 + 2) * 6 + 2) = bad; // vertex (2, 2, 2)
        const StepValues values = ramp.view();
        const CellSet set = all_cells(values, 0);
        const auto normal = [&](std::size_t x, std::size_t y, std::size_t z) {
            return set.points[(z * 5 + y) * 5 + x].plane;
        };
        EXPECT_EQ(normal(2, 2, 2), 0u) << "a vertex of its own";
        EXPECT_EQ(normal(3, 2, 2), 0u) << "a neighbor along x";
        EXPECT_EQ(normal(2, 0, 2), 0u) << "a neighbor along y";
        EXPECT_NE(normal(3, 3, 2), 0u) << "a diagonal neighbor does not matter";
        EXPECT_NE(normal(4, 2, 2), 0u);
    }
}

TEST(CellSet, HugeAndTinyGradientsKeepTheirDirection) {
    for (const double factor : {1e-300, 1e300}) {
        const TestField field(
            {4, 4, 4}, 1, ValueType::f64,
            [&](double x, double y, double, double) { return factor * (x - 2 * y); });
        const glm::dvec3 expected = glm::normalize(glm::dvec3(-1, 2, 0));
        EXPECT_LT(glm::distance(cell_normal(field.view(), 0, 13), expected), 1e-9) << factor;
    }
}

void expect_rows_partition_the_cells(const StepValues& values, const CellSet& set) {
    ASSERT_EQ(set.points.size(), set.ids.size());
    ASSERT_EQ(set.rows.front().begin, 0u);
    for (std::size_t r = 0; r < set.rows.size(); ++r) {
        const CellRow& row = set.rows[r];
        const std::size_t end = r + 1 < set.rows.size() ? set.rows[r + 1].begin : set.ids.size();
        ASSERT_LT(row.begin, end) << "no row is empty";
        if (r > 0) {
            EXPECT_LT(std::pair(set.rows[r - 1].z, set.rows[r - 1].y), std::pair(row.z, row.y));
        }
        for (std::size_t i = row.begin; i < end; ++i) {
            const auto [x, y, z] = values.grid.cell_of(set.ids[i]);
            EXPECT_EQ(std::tuple(x, y, z),
                      std::tuple(set.points[i].x, set.points[i].y, set.points[i].z));
            EXPECT_EQ(std::tuple(row.y, row.z), std::tuple(y, z));
        }
    }
}

TEST(CellSet, RowsPartitionTheCellsInOrder) {
    std::mt19937 random(test_seed());
    for (const std::array<std::uint32_t, 3> vertices : {std::array{9u, 8u, 7u}, {5u, 41u, 31u}}) {
        const TestField field({vertices}, 1, ValueType::f32, turbulence(random));
        CellSet set;
        scan(field.view(), {Instant(0), 0.05}, set.ids);
        ASSERT_FALSE(set.ids.empty());
        ASSERT_TRUE(shade_cells(field.view(), set));
        expect_rows_partition_the_cells(field.view(), set);
    }
}

TEST(CellSet, HasAllRowsHoweverManyThereAre) {
    for (const std::uint32_t rows : {255u, 256u, 257u, 512u}) {
        const TestField field({4, rows + 1, 2}, 1, ValueType::u8,
                              [](double x, double, double, double) { return 100 * x; });
        CellSet set;
        scan(field.view(), {Instant(0), 150}, set.ids);
        ASSERT_TRUE(shade_cells(field.view(), set));
        EXPECT_EQ(set.rows.size(), rows);
        expect_rows_partition_the_cells(field.view(), set);
    }
}

TEST(CellSet, AnEmptySetHasNoRowsAndAStoppedOneSaysSo) {
    const TestField field({9, 8, 7}, 1, ValueType::f32, moving_sphere);
    CellSet set;
    EXPECT_TRUE(shade_cells(field.view(), set));
    EXPECT_TRUE(set.rows.empty());
    set.ids = {0, 1};
    std::stop_source stop;
    stop.request_stop();
    EXPECT_FALSE(shade_cells(field.view(), set, stop.get_token()));
}

TEST(IdSort, FewAndManyIdsAreSortedAndForeignOnesDropped) {
    const std::uint32_t seed = test_seed();
    std::mt19937 random(seed);
    constexpr std::uint32_t kCells = 100'003;
    for (const std::size_t count : {0u, 1u, 50u, 5'000u, 100'003u}) {
        std::vector<CellId> expected(kCells);
        std::iota(expected.begin(), expected.end(), CellId{0});
        std::shuffle(expected.begin(), expected.end(), random);
        expected.resize(count);
        std::vector<CellId> ids = expected;
        ids.insert(ids.end(), {kCells, kCells + 1, 0xffffffffu});
        if (count > 0)
            ids.push_back(ids.front());
        std::sort(expected.begin(), expected.end());
        sort_ids(ids, kCells);
        EXPECT_EQ(ids, expected) << count;
    }
}

TEST(IdSort, IdsInGroupsAreSortedAsTheyAreWithoutGroups) {
    const std::uint32_t seed = test_seed();
    std::mt19937 random(seed);
    constexpr std::uint32_t kCells = 100'003;
    for (const std::uint32_t group : {1u, 64u, 4'099u, 100'003u, 200'000u})
        for (const std::size_t count : {0u, 1u, 50u, 5'000u, 100'003u}) {
            std::vector<CellId> expected(kCells);
            std::iota(expected.begin(), expected.end(), CellId{0});
            std::shuffle(expected.begin(), expected.end(), random);
            expected.resize(count);
            if (count > 0)
                expected.push_back(expected.front());
            std::vector<CellId> ids = expected;
            std::stable_sort(ids.begin(), ids.end(),
                             [&](CellId a, CellId b) { return a / group < b / group; });
            ids.insert(ids.end(), {kCells, 0xffffffffu});
            sort_ids(expected, kCells);
            sort_ids(ids, kCells, group);
            EXPECT_EQ(ids, expected) << count << " in groups of " << group;
        }
}

} // namespace
} // namespace isochron::index
