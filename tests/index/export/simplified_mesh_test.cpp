// Simplified surfaces: the distance that is said is one that no point exceeds, and what was closed stays
// closed.
#include "index/export/simplified_mesh.h"

#include "index/export/mesh_distance.h"
#include "index/scan/scan.h"
#include "index/surface/mesh_parts.h"
#include "tests/support/test_field.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <type_traits>

namespace isochron::index {
namespace {

using Corners = std::array<glm::dvec3, 3>;

/// By which of its corners, edges and side a point lies (C. Ericson, "Real-Time Collision Detection",
/// 2004, section 5.1.5).
double distance_by_regions(const glm::dvec3& p, const Corners& t) {
    const auto& [a, b, c] = t;
    const glm::dvec3 ab = b - a, ac = c - a;
    if (glm::length(glm::cross(ab, ac)) < 1e-12) { // no area: its longest side
        const double sides[]{glm::length(ab), glm::length(c - b), glm::length(ac)};
        const glm::dvec3 ends[][2]{{a, b}, {b, c}, {a, c}};
        const auto [from, to] = ends[std::ranges::max_element(sides) - sides];
        const double length = glm::length(to - from);
        const double along =
            length > 0 ? std::clamp(glm::dot(p - from, to - from) / length, 0.0, length) : 0;
        return glm::length(p - from - (length > 0 ? along / length : 0) * (to - from));
    }
    const double d1 = glm::dot(ab, p - a), d2 = glm::dot(ac, p - a);
    if (d1 <= 0 && d2 <= 0)
        return glm::length(p - a);
    const double d3 = glm::dot(ab, p - b), d4 = glm::dot(ac, p - b);
    if (d3 >= 0 && d4 <= d3)
        return glm::length(p - b);
    const double d5 = glm::dot(ab, p - c), d6 = glm::dot(ac, p - c);
    if (d6 >= 0 && d5 <= d6)
        return glm::length(p - c);
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0 && d1 >= 0 && d3 <= 0)
        return glm::length(p - (a + d1 / (d1 - d3) * ab));
    if (vb <= 0 && d2 >= 0 && d6 <= 0)
        return glm::length(p - (a + d2 / (d2 - d6) * ac));
    if (va <= 0 && d4 >= d3 && d5 >= d6)
        return glm::length(p - (b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b)));
    return glm::length(p - (a + ab * (vb / (va + vb + vc)) + ac * (vc / (va + vb + vc))));
}

PlainMesh plain(const CellMesh& mesh, const Grid& grid) {
    PlainMesh made;
    for (const MeshVertex& vertex : mesh.vertices)
        made.points.push_back(grid.physical(position_of(vertex)));
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
        made.triangles.push_back({mesh.triangles[i], mesh.triangles[i + 1], mesh.triangles[i + 2]});
    return made;
}

/// The farthest of points spread over one mesh, by looking at every triangle of the other one.
/// @param apart distance between these points at most
double sampled_distance(const PlainMesh& from, const PlainMesh& to, double apart) {
    double farthest = 0;
    for (std::size_t i = 0; i < from.triangles.size(); ++i) {
        const auto [a, b, c] = from.corners(i);
        const double side = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
        const int cuts = 1 + int(side / apart);
        for (int u = 0; u <= cuts; ++u)
            for (int v = 0; u + v <= cuts; ++v) {
                const glm::dvec3 p =
                    a + (b - a) * (double(u) / cuts) + (c - a) * (double(v) / cuts);
                double nearest = std::numeric_limits<double>::infinity();
                for (std::size_t k = 0; k < to.triangles.size() && nearest > farthest; ++k)
                    nearest = std::min(nearest, distance_by_regions(p, to.corners(k)));
                farthest = std::max(farthest, nearest);
            }
    }
    return farthest;
}

/// How a mesh hangs together.
struct Connections {
    bool closed = true;   ///< two triangles at each edge, which run along it against each other
    std::size_t most = 0; ///< triangles at an edge
    long euler = 0;       ///< points - edges + triangles
};

/// @param key what tells points apart: their numbers, or their places
template <class Key>
Connections connections(const PlainMesh& mesh, const Key& key) {
    using Point = std::invoke_result_t<Key, std::uint32_t>;
    std::map<std::pair<Point, Point>, std::array<std::size_t, 2>> edges; // both directions
    std::set<Point> points;
    long triangles = 0;
    for (const auto& at : mesh.triangles) {
        const std::array corner{key(at[0]), key(at[1]), key(at[2])};
        if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0])
            continue;
        ++triangles;
        for (std::size_t i = 0; i < 3; ++i) {
            const Point &from = corner[i], &to = corner[(i + 1) % 3];
            points.insert(from);
            ++edges[std::minmax(from, to)][from < to];
        }
    }
    Connections found;
    for (const auto& [edge, count] : edges) {
        found.closed = found.closed && count[0] == 1 && count[1] == 1;
        found.most = std::max(found.most, count[0] + count[1]);
    }
    found.euler = long(points.size()) - long(edges.size()) + triangles;
    return found;
}
Connections by_number(const PlainMesh& mesh) {
    return connections(mesh, [](std::uint32_t i) { return i; });
}
Connections by_place(const PlainMesh& mesh) {
    return connections(mesh, [&](std::uint32_t i) {
        return std::array{mesh.points[i].x, mesh.points[i].y, mesh.points[i].z};
    });
}

CellMesh surface_of(const TestField& field, double isovalue) {
    const Query query{Instant(0), isovalue};
    std::vector<CellId> ids;
    scan(field.view(), query, ids);
    std::vector<MeshMaker> team(1);
    CellMesh mesh;
    EXPECT_TRUE(make_mesh(team, field.view(), query, ids, mesh));
    return mesh;
}

/// Fields of many kinds; those that are walled are low at the border of the grid, so that their surfaces
/// are closed. Whole numbers put vertices into one place.
struct RandomSurface {
    explicit RandomSurface(std::mt19937& random) {
        const auto between = [&](double low, double high) {
            return std::uniform_real_distribution(low, high)(random);
        };
        const std::array<std::uint32_t, 3> size{std::uint32_t(between(6, 14)),
                                                std::uint32_t(between(6, 14)),
                                                std::uint32_t(between(6, 14))};
        walled = random() % 2 == 0;
        const bool whole = random() % 4 == 0;
        TestField::Function function;
        switch (random() % 4) {
        case 0: {
            const double x0 = between(3, 9), y0 = between(3, 9), z0 = between(3, 9),
                         r = between(2, 6);
            function = [=](double x, double y, double z, double) {
                return r - std::hypot(x - x0, y - y0, z - z0);
            };
            break;
        }
        case 1: {
            const double a = between(0.2, 1), b = between(0.2, 1), c = between(0.2, 1);
            function = [=](double x, double y, double z, double) {
                return std::sin(a * x) + std::cos(b * y) * std::sin(c * z);
            };
            break;
        }
        case 2: function = turbulence(random); break;
        default: function = white_noise(random);
        }
        const auto made = [=, wall = walled](double x, double y, double z, double t) {
            const bool border = x < 1 || y < 1 || z < 1 || x > size[0] - 1.5 || y > size[1] - 1.5 ||
                                z > size[2] - 1.5;
            if (wall && border)
                return -5.0;
            return whole ? std::round(3 * function(x, y, z, t)) : function(x, y, z, t);
        };
        field = std::make_unique<TestField>(size, 1, ValueType::f32, made);
        grid = field->view().grid;
        grid.origin = {between(-1e3, 1e3), 0, between(0, 1e3)};
        if (random() % 3 == 0)
            grid.spacing = {between(0.3, 3), between(0.3, 3), between(0.3, 3)};
        mesh = surface_of(*field, whole ? double(int(between(-1, 2))) : between(-0.3, 0.3));
    }
    bool walled = false;
    std::unique_ptr<TestField> field;
    Grid grid;
    CellMesh mesh;
};

TEST(SimplifiedMesh, LiesNoFartherOffThanItIsSaidAndStaysClosed) {
    const std::uint32_t seed = test_seed();
    std::mt19937 random(seed);
    double worst = 0;
    std::size_t before = 0, left = 0;
    int counted = 0, closed = 0;
    for (int round = 0; counted < tries(72) && round < 2000; ++round) {
        const RandomSurface surface(random);
        if (surface.mesh.triangles.size() < 60 || surface.mesh.triangles.size() > 6000)
            continue;
        ++counted;
        const double side = shortest_side(surface.grid);
        const double most =
            side * std::pow(10.0, std::uniform_real_distribution(-1.7, 0.3)(random));
        CellMesh mesh = surface.mesh;
        const double said = simplify(mesh, surface.grid, most);
        EXPECT_LE(said, most);
        EXPECT_LE(mesh.triangles.size(), surface.mesh.triangles.size());
        const PlainMesh all = plain(surface.mesh, surface.grid), fewer = plain(mesh, surface.grid);
        const double apart = std::max(0.2 * side, most / 2);
        const double found =
            std::max(sampled_distance(all, fewer, apart), sampled_distance(fewer, all, apart));
        const std::string where =
            fmt::format("round {}, seed {}: {} of {} triangles, asked {}, said {}, found {}", round,
                        seed, fewer.triangles.size(), all.triangles.size(), most, said, found);
        EXPECT_LE(found, said + 1e-9) << where;
        EXPECT_GE(found + apart, said / 1.05 - most / 100)
            << where; // the farthest lies between samples
        if (found > 0)
            worst = std::max(worst, found / said);
        EXPECT_EQ(by_number(fewer).euler, by_number(all).euler) << where;
        for (const auto& of : {by_number, by_place}) {
            const Connections was = of(all), is = of(fewer);
            EXPECT_LE(is.most, was.most) << where << (of == by_place ? ", by place" : "");
            EXPECT_TRUE(is.closed || !was.closed) << where << (of == by_place ? ", by place" : "");
        }
        closed += by_number(all).closed ? 1 : 0;
        before += all.triangles.size();
        left += fewer.triangles.size();
    }
    fmt::print("{} surfaces, {} closed; worst {:.4f} of what is said; {} of {} triangles left\n",
               counted, closed, worst, left, before);
    EXPECT_GT(worst, 0.9) << "what is said is no guess far above";
    EXPECT_GT(closed, counted / 4);
    EXPECT_LT(left, before / 2);
}

TEST(SimplifiedMesh, StaysAsItIsWhereNothingMayMove) {
    std::mt19937 random(test_seed());
    const TestField noise({9, 9, 9}, 1, ValueType::f32, white_noise(random));
    const CellMesh mesh = surface_of(noise, 0.1);
    CellMesh same = mesh;
    EXPECT_LE(simplify(same, noise.view().grid, 1e-9), 1e-9);
    EXPECT_EQ(same.triangles, mesh.triangles);
    CellMesh none;
    EXPECT_EQ(simplify(none, noise.view().grid, 1), 0);
}

TEST(SimplifiedMesh, OfAPlaneIsTwoTriangles) {
    const TestField plane({12, 9, 7}, 1, ValueType::f32, [](double x, double y, double z, double) {
        return z - 2.25 + 0 * x * y;
    });
    CellMesh mesh = surface_of(plane, 0);
    EXPECT_LE(simplify(mesh, plane.view().grid, 0.01), 1e-4);
    EXPECT_EQ(mesh.triangles.size(), 6u);
}

TEST(SimplifiedMesh, IsLeftWithWhatIsCanceled) {
    std::mt19937 random(test_seed());
    const TestField field({20, 20, 20}, 1, ValueType::f32, turbulence(random));
    CellMesh mesh = surface_of(field, 0);
    int calls = 0;
    EXPECT_THROW(simplify(mesh, field.view().grid, 0.5,
                          [&] {
                              if (++calls == 2)
                                  throw std::runtime_error("canceled");
                          }),
                 std::runtime_error);
}

TEST(MeshDistance, OfAFoldIsThatOfItsRidge) {
    // A roof of height 0.5 over a flat square, and the square beneath: the ridge is 0.5 above it.
    using Triangle = std::array<std::uint32_t, 3>;
    PlainMesh roof, flat;
    roof.points = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0.5}, {2, 1, 0.5}, {0, 2, 0}, {2, 2, 0}};
    roof.triangles = {Triangle{0, 1, 2}, Triangle{1, 3, 2}, Triangle{2, 3, 4}, Triangle{3, 5, 4}};
    flat.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}};
    flat.triangles = {Triangle{0, 1, 2}, Triangle{1, 3, 2}};
    const FarthestPoint up = farthest_from(roof, NearestTriangle(flat), {.negligible = 1e-6});
    EXPECT_NEAR(up.lower, 0.5, 1e-12);
    EXPECT_NEAR(up.upper, 0.5, 0.5 * 0.05);
    // From the square, the farthest points lie below the ridge, nearest to a slope: 1 / sqrt(1 + 4).
    const FarthestPoint down = farthest_from(flat, NearestTriangle(roof), {.negligible = 1e-6});
    EXPECT_LE(down.lower, std::sqrt(0.2) + 1e-12);
    EXPECT_GE(down.upper, std::sqrt(0.2));
    EXPECT_LE(down.upper, 1.05 * down.lower + 1e-12);
    const FarthestPoint early =
        farthest_from(roof, NearestTriangle(flat), {.most = 0.1, .negligible = 1e-6});
    EXPECT_TRUE(std::isinf(early.upper));
    EXPECT_EQ(early.beyond, (std::vector<std::uint32_t>{0, 1, 2, 3})) << "all meet the ridge";
}

TEST(ShortestSide, IsThatOfAnyCell) {
    Grid grid;
    grid.vertices = {3, 3, 4};
    grid.spacing = {0.5, 2, 1};
    EXPECT_EQ(shortest_side(grid), 0.5);
    grid.positions[2] = AxisPositions({0, 1, 1.25, 3});
    EXPECT_EQ(shortest_side(grid), 0.25);
}

} // namespace
} // namespace isochron::index
