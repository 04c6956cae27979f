// Surfaces at an instant: the cut edges of the active cells by brute force, fewer triangles where there
// are too many, and the first triangle that a ray meets.
#include "index/extraction/cell_ray.h"
#include "index/extraction/instant_surfaces.h"
#include "tests/support/indexed.h"
#include "tests/support/test_seed.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <tuple>

namespace isochron::index {
namespace {

constexpr std::uint64_t kAny = 1 << 24; ///< more triangles than there are

using Edge = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, int>; ///< lower end, axis

/// What a query has by definition, from all values at the instant.
struct Expected {
    std::size_t cells = 0;
    std::set<Edge> edges;
};
Expected by_definition(const StepValues& values, Instant at, double isovalue) {
    const auto [nx, ny, nz] = values.grid.vertices;
    const auto value = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        const std::size_t vertex = x + std::size_t{nx} * (y + std::size_t{ny} * z);
        const double now = scaled_value(values, at.step, vertex);
        if (!at.between())
            return now;
        const double next = scaled_value(values, at.step + 1, vertex);
        return now + (next - now) * at.fraction / Instant::kFractions;
    };
    Expected found;
    for (std::uint32_t z = 0; z + 1 < nz; ++z)
        for (std::uint32_t y = 0; y + 1 < ny; ++y)
            for (std::uint32_t x = 0; x + 1 < nx; ++x) {
                double low = kInfinity, high = -kInfinity;
                bool whole = true;
                for (std::uint32_t i = 0; i < 8; ++i) {
                    const double v = value(x + (i & 1), y + (i >> 1 & 1), z + (i >> 2));
                    whole = whole && !std::isnan(v);
                    low = std::min(low, v);
                    high = std::max(high, v);
                }
                if (!whole || !(low < isovalue && isovalue <= high))
                    continue;
                ++found.cells;
                for (int axis = 0; axis < 3; ++axis)
                    for (std::uint32_t i = 0; i < 8; ++i) {
                        if (i >> axis & 1)
                            continue;
                        const std::array<std::uint32_t, 3> a{x + (i & 1), y + (i >> 1 & 1),
                                                             z + (i >> 2)};
                        auto b = a;
                        ++b[static_cast<std::size_t>(axis)];
                        if ((value(a[0], a[1], a[2]) < isovalue) !=
                            (value(b[0], b[1], b[2]) < isovalue))
                            found.edges.emplace(a[0], a[1], a[2], axis);
                    }
            }
    return found;
}

TEST(InstantSurfaces, CutTheEdgesThatTheQuerysCellsHave) {
    std::mt19937 random(test_seed());
    int cells = 0;
    for (const ValueType type : kAllTypes)
        for (const bool holes : {false, true}) {
            const bool real = type == ValueType::f32 || type == ValueType::f64;
            if (holes && !real)
                continue;
            const auto smooth = turbulence(random, 6);
            const TestField field({13, 11, 9}, 3, type,
                                  [&](double x, double y, double z, double t) {
                                      if (holes && random() % 40 == 0)
                                          return kNaN;
                                      return 50 + 45 * smooth(x, y, z, t);
                                  });
            const test_support::TestFolder folder;
            const auto file = indexed(folder, field.view());
            for (const Instant at :
                 {Instant(0), Instant(2), Instant(0, 21'845), Instant(1, 60'000)})
                for (const double isovalue : {50.37, 61.8, 1e9}) {
                    const auto made = instant_surfaces(file, {at, {isovalue, 40.21}}, kAny);
                    ASSERT_TRUE(made);
                    EXPECT_TRUE(made->exact());
                    std::size_t all = 0;
                    for (std::size_t i = 0; i < 2; ++i) {
                        const Expected expected =
                            by_definition(field.view(), at, made->query.isovalues[i]);
                        all += expected.cells;
                        std::set<Edge> edges;
                        const CellMeshPtr& mesh = made->meshes[i];
                        EXPECT_EQ(mesh == nullptr, expected.cells == 0);
                        for (std::size_t k = 0; mesh && k < mesh->vertices.size(); ++k) {
                            const MeshVertex& v = mesh->vertices[k];
                            EXPECT_TRUE(edges.emplace(v.x, v.y, v.z, v.axis).second);
                        }
                        EXPECT_EQ(edges, expected.edges) << name_of(type) << ' ' << at.number();
                        cells += static_cast<int>(expected.cells);
                    }
                    EXPECT_EQ(made->cells, all);
                }
        }
    EXPECT_GT(cells, 5000);
}

TEST(InstantSurfaces, HaveNoMoreTrianglesThanAreWished) {
    const std::array<std::uint32_t, 3> vertices{41, 40, 43};
    const auto radius = [](const glm::dvec3& at) { return glm::distance(at, glm::dvec3(20)); };
    const TestField field(vertices, 2, ValueType::f32, [&](double x, double y, double z, double) {
        return radius({x, y, z});
    });
    const test_support::TestFolder folder;
    const auto file = indexed(folder, field.view());
    const SurfacesQuery query{Instant(1), {15.0}};
    const auto whole = instant_surfaces(file, query, kAny);
    ASSERT_TRUE(whole && whole->exact());
    const std::uint64_t all = whole->triangles();
    std::set<std::pair<unsigned, std::uint32_t>> ways;
    for (const std::uint64_t most : {all, all / 3, all / 10, all / 60, std::uint64_t{24}}) {
        const auto fewer = instant_surfaces(file, query, most);
        ASSERT_TRUE(fewer);
        EXPECT_LE(fewer->triangles(), most);
        EXPECT_GT(fewer->triangles(), most / 12);
        EXPECT_EQ(fewer->exact(), most == all);
        ways.emplace(fewer->level, fewer->edge);
        const double off = most == all ? 0.02 : 0.1 + 0.5 * (1 << fewer->level);
        for (const MeshVertex& vertex : fewer->meshes[0]->vertices)
            ASSERT_NEAR(radius(position_of(vertex)), 15.0, off) << most;
    }
    EXPECT_GE(ways.size(), 4u); // clusters, and levels of detail
    EXPECT_GT(ways.rbegin()->first, 0u);
}

/// Means of neighbors keep a linear field as it is: so its surface stays where it was.
TEST(InstantSurfaces, OfCoarserLevelsLieWhereTheVolumesDo) {
    for (int axis = 0; axis < 3; ++axis) {
        const TestField field(
            {38, 39, 40}, 1, ValueType::f64,
            [&](double x, double y, double z, double) { return glm::dvec3(x, y, z)[axis]; });
        const test_support::TestFolder folder;
        const auto file = indexed(folder, field.view());
        const auto coarse = instant_surfaces(file, {Instant(0), {17.3}}, 30);
        ASSERT_TRUE(coarse && coarse->level > 0);
        const Grid& grid = file->info().grid;
        glm::dvec3 low(kInfinity), high(-kInfinity);
        for (const MeshVertex& vertex : coarse->meshes[0]->vertices) {
            const glm::dvec3 at = position_of(vertex);
            EXPECT_NEAR(at[axis], 17.3, 1e-6);
            low = glm::min(low, at);
            high = glm::max(high, at);
        }
        for (int other = 0; other < 3; ++other) // it spans the data
            if (other != axis) {
                EXPECT_LT(low[other], 9);
                EXPECT_GT(high[other], grid.vertices[static_cast<std::size_t>(other)] - 10);
            }
    }
}

TEST(InstantSurfaces, AreNullWhenStopped) {
    const TestField field({9, 9, 9}, 1, ValueType::f32,
                          [](double x, double, double, double) { return x; });
    const test_support::TestFolder folder;
    const auto file = indexed(folder, field.view());
    std::stop_source stop;
    stop.request_stop();
    EXPECT_FALSE(instant_surfaces(file, {Instant(0), {4.5}}, kAny, stop.get_token()));
}

/// How far along a ray it meets a triangle, by the plane and the three sides.
std::optional<double> meeting(const std::array<glm::dvec3, 3>& corners, const Ray& ray) {
    const glm::dvec3 n = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double along = glm::dot(n, corners[0] - ray.origin) / glm::dot(n, ray.direction);
    if (!(along >= 0))
        return std::nullopt;
    const glm::dvec3 at = ray.origin + along * ray.direction;
    for (std::size_t i = 0; i < 3; ++i)
        if (glm::dot(glm::cross(corners[(i + 1) % 3] - corners[i], at - corners[i]), n) < 0)
            return std::nullopt;
    return along;
}

TEST(InstantSurfaces, AreMetWhereTheFirstTriangleIs) {
    std::mt19937 random(test_seed());
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution(low, high)(random);
    };
    Grid even{.vertices = {12, 10, 11}, .origin = {3, -2, 1e4}, .spacing = {0.3, 1.0, 2.0}};
    even.direction =
        glm::dmat3(glm::mat3_cast(glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, -1)))));
    Grid uneven = even;
    uneven.positions[1] = AxisPositions({0, 0.2, 0.3, 1.4, 2, 3.7, 4, 6, 8.5, 9});
    int hits = 0;
    for (const Grid& grid : {even, uneven}) {
        const auto smooth = turbulence(random, 5);
        const TestField field(grid.vertices, 1, ValueType::f32, smooth);
        StepValues values = field.view();
        values.grid = grid;
        const test_support::TestFolder folder;
        const auto file = indexed(folder, values);
        const auto made = instant_surfaces(file, {Instant(0), {0.05, 0.3}}, kAny);
        ASSERT_TRUE(made);
        for (int i = 0; i < 200; ++i) {
            const auto place = [&](double beyond) {
                return grid.physical({uniform(-beyond, 11 + beyond), uniform(-beyond, 9 + beyond),
                                      uniform(-beyond, 10 + beyond)});
            };
            const glm::dvec3 from = place(9);
            const Ray ray{from, place(0) - from};
            const auto surfaces = static_cast<std::uint32_t>(1 + random() % 3);
            std::optional<RayHit> first;
            for (std::size_t k = 0; k < 2; ++k)
                for (std::size_t c = 0;
                     (surfaces >> k & 1) && c < made->meshes[k]->triangles.size(); c += 3) {
                    std::array<glm::dvec3, 3> corners;
                    for (std::size_t n = 0; n < 3; ++n)
                        corners[n] = grid.physical(position_of(
                            made->meshes[k]->vertices[made->meshes[k]->triangles[c + n]]));
                    if (const auto along = meeting(corners, ray);
                        along && (!first || *along < first->along))
                        first = RayHit{k, *along};
                }
            const auto hit = first_hit(*made, grid, ray, surfaces);
            ASSERT_EQ(hit.has_value(), first.has_value());
            if (!hit)
                continue;
            ++hits;
            EXPECT_EQ(hit->surface, first->surface);
            EXPECT_NEAR(hit->along, first->along, 1e-6);
            EXPECT_LT(glm::distance(hit->at, ray.origin + first->along * ray.direction), 1e-5);
        }
    }
    EXPECT_GT(hits, 60);
}

} // namespace
} // namespace isochron::index
