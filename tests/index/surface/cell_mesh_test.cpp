// Meshes of active cells agree with their definition, edge by edge, and closed surfaces are closed.
#include "index/scan/scan.h"
#include "index/surface/mesh_cases.h"
#include "index/surface/mesh_parts.h"
#include "tests/support/test_field.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace isochron::index {
namespace {

using CutEdge = std::array<std::uint32_t, 4>; ///< the lower end, and the axis

CutEdge edge_of(const MeshVertex& vertex) {
    return {vertex.x, vertex.y, vertex.z, vertex.axis};
}

std::vector<CellId> active_cells(const StepValues& values, const Query& query) {
    std::vector<CellId> ids;
    scan(values, query, ids);
    return ids;
}

CellMesh mesh_of(const StepValues& values, const Query& query, std::size_t makers = 1) {
    std::vector<MeshMaker> team(makers);
    CellMesh mesh;
    EXPECT_TRUE(make_mesh(team, values, query, active_cells(values, query), mesh));
    return mesh;
}

double value_at(const StepValues& values, std::size_t step, std::array<std::uint32_t, 3> v) {
    const auto& n = values.grid.vertices;
    return scaled_value(values, step, (std::size_t{v[2]} * n[1] + v[1]) * n[0] + v[0]);
}

struct Cut {
    double share, digits; ///< and how far rounding leaves that open
};

/// Edges of the given cells whose ends lie on different sides, and where they are cut.
std::map<CutEdge, Cut> cuts_of(const StepValues& values, const Query& query,
                               std::span<const CellId> cells) {
    std::map<CutEdge, Cut> cuts;
    for (const CellId id : cells)
        for (std::uint32_t e = 0; e < kCellEdges; ++e) {
            std::array<std::uint32_t, 3> from = values.grid.cell_of(id);
            const std::uint32_t axis = e / 4;
            from[axis == 0 ? 1 : 0] += e % 2;
            from[axis == 2 ? 1 : 2] += e / 2 % 2;
            auto to = from;
            ++to[axis];
            const double a = value_at(values, query.instant.step, from),
                         b = value_at(values, query.instant.step, to);
            if ((a >= query.isovalue) != (b >= query.isovalue))
                cuts[{from[0], from[1], from[2], axis}] = {
                    (query.isovalue - a) / (b - a),
                    1e-15 * std::max({std::abs(a), std::abs(b), 1.0}) / std::abs(b - a)};
        }
    return cuts;
}

/// How often each side of a triangle is met, less how often its opposite is.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> open_sides(const CellMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    std::set<std::pair<std::uint32_t, std::uint32_t>> met;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const std::uint32_t from = mesh.triangles[i];
        const std::uint32_t to = mesh.triangles[i % 3 == 2 ? i - 2 : i + 1];
        EXPECT_TRUE(met.emplace(from, to).second) << "two triangles on one side";
        ++sides[std::minmax(from, to)];
    }
    std::erase_if(sides, [&](const auto& side) {
        return met.contains(side.first) && met.contains({side.first.second, side.first.first});
    });
    return sides;
}

/// Random whole numbers: many ties.
TestField steps_of(std::mt19937& random, std::array<std::uint32_t, 3> size, ValueType type,
                   const Scaling& scaling = {}) {
    return {size, 2, type, scaled(white_noise(random), 4, 5), scaling};
}

TEST(CellMesh, HasOneVertexOnEveryCutEdgeOfEveryTypeScalingAndTie) {
    std::mt19937 random(test_seed());
    for (const ValueType type : kAllTypes)
        for (const Scaling& scaling : kScalings) {
            const TestField field = steps_of(random, {5, 6, 7}, type, scaling);
            const StepValues values = field.view();
            for (const double isovalue : ties(values, 5)) {
                const Query query{Instant(1), isovalue};
                const auto cells = active_cells(values, query);
                const auto cuts = cuts_of(values, query, cells);
                const CellMesh mesh = mesh_of(values, query);
                ASSERT_EQ(mesh.vertices.size(), cuts.size());
                for (const MeshVertex& vertex : mesh.vertices) {
                    const auto found = cuts.find(edge_of(vertex));
                    ASSERT_NE(found, cuts.end());
                    const double share =
                        position_of(vertex)[vertex.axis] - std::floor(found->first[vertex.axis]);
                    EXPECT_NEAR(share, found->second.share, 1e-6 + found->second.digits);
                }
                ASSERT_EQ(mesh.cases.size(), cells.size());
                std::size_t triangles = 0;
                for (const std::uint8_t upper : mesh.cases)
                    triangles += mesh_cases()[upper].triangles;
                EXPECT_EQ(mesh.triangles.size(), 3 * triangles);
            }
        }
}

TEST(CellMesh, TrianglesLieInTheirCellsAndCloseWithinTheGrid) {
    std::mt19937 random(test_seed());
    for (int round = 0; round < 20; ++round) {
        const TestField field = steps_of(random, {8, 9, 10}, ValueType::u8);
        const StepValues values = field.view();
        const Query query{Instant(0), 4.5 + round % 3};
        const CellMesh mesh = mesh_of(values, query);
        const auto cells = active_cells(values, query);
        std::size_t corner = 0;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const auto at = values.grid.cell_of(cells[i]);
            for (int k = 3 * mesh_cases()[mesh.cases[i]].triangles; k > 0; --k) {
                const glm::dvec3 p = position_of(mesh.vertices[mesh.triangles[corner++]]);
                for (int axis = 0; axis < 3; ++axis) {
                    EXPECT_GE(p[axis], at[axis]);
                    EXPECT_LE(p[axis], at[axis] + 1);
                }
            }
        }
        for (const auto& [side, count] : open_sides(mesh)) {
            // Only at the border of the grid: both ends in one of its faces.
            const glm::dvec3 a = position_of(mesh.vertices[side.first]);
            const glm::dvec3 b = position_of(mesh.vertices[side.second]);
            bool on_border = false;
            for (int axis = 0; axis < 3; ++axis) {
                const double last = values.grid.vertices[axis] - 1;
                on_border |= a[axis] == b[axis] && (a[axis] == 0 || a[axis] == last);
            }
            EXPECT_TRUE(on_border);
            EXPECT_EQ(count, 1);
        }
    }
}

TEST(CellMesh, EveryWayThroughACellHasNoSideInAFaceButThoseOfItsPolygons) {
    // A side between two edges of one face, met in both directions within the cell, would meet
    // another one in the neighbor.
    for (int upper = 1; upper < 255; ++upper) {
        const MeshCase& way = mesh_cases()[upper];
        for (int i = 0; i < 3 * way.triangles; ++i) {
            const int a = way.edges[i], b = way.edges[i % 3 == 2 ? i - 2 : i + 1];
            const auto in = [](int edge, int axis) { // which side of the cell; -1 across
                const int along = edge / 4;
                if (along == axis)
                    return -1;
                const bool first = (axis == 0) || (axis == 1 && along == 0);
                return first ? edge % 2 : edge / 2 % 2;
            };
            int back = 0;
            for (int j = 0; j < 3 * way.triangles; ++j)
                back += way.edges[j] == b && way.edges[j % 3 == 2 ? j - 2 : j + 1] == a;
            for (int axis = 0; axis < 3; ++axis)
                EXPECT_FALSE(back > 0 && in(a, axis) >= 0 && in(a, axis) == in(b, axis)) << upper;
        }
    }
}

TEST(CellMesh, OfASphereIsClosedAndFacesOutwards) {
    const TestField field({61, 50, 60}, 2, ValueType::f32, moving_sphere);
    const CellMesh mesh = mesh_of(field.view(), {Instant(1), 112.5});
    EXPECT_TRUE(open_sides(mesh).empty());
    EXPECT_EQ(mesh.vertices.size(), mesh.triangles.size() / 6 + 2); // Euler
    const glm::dvec3 middle(22.2, 19.09, 22.12);
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        std::array<glm::dvec3, 3> p;
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = position_of(mesh.vertices[mesh.triangles[i + k]]);
        EXPECT_GE(glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[0] - middle), 0.0);
    }
    for (const MeshVertex& vertex : mesh.vertices)
        EXPECT_GT(glm::dot(normal_of(vertex), glm::normalize(position_of(vertex) - middle)), 0.999);
}

TEST(CellMesh, NormalsArePhysicalAndTurnWithAFallingScaling) {
    const TestField field({9, 9, 9}, 1, ValueType::f64,
                          [](double x, double y, double z, double) { return x + 2 * y - z; });
    StepValues values = field.view();
    values.grid.spacing = {0.5, 3.0, 1.25};
    const glm::dvec3 up = glm::normalize(glm::dvec3(1, 2, -1) / values.grid.spacing);
    for (const MeshVertex& vertex : mesh_of(values, {Instant(0), 8.3}).vertices)
        EXPECT_LT(glm::distance(normal_of(vertex), -up), 1e-4);
    values.scaling.slope = -1;
    const CellMesh falling = mesh_of(values, {Instant(0), -8.3});
    ASSERT_FALSE(falling.vertices.empty());
    for (const MeshVertex& vertex : falling.vertices)
        EXPECT_LT(glm::distance(normal_of(vertex), up), 1e-4);
}

TEST(CellMesh, LeavesOutCellsWithNaNAndEndsThere) {
    std::mt19937 random(test_seed());
    for (int round = 0; round < 10; ++round) {
        TestField field({9, 8, 7}, 1, ValueType::f32, white_noise(random));
        for (int i = 0; i < 12; ++i)
            field.at<float>(0, random() % (9 * 8 * 7)) = std::numeric_limits<float>::quiet_NaN();
        const StepValues values = field.view();
        const Query query{Instant(0), 0.1};
        const auto cells = active_cells(values, query);
        const auto cuts = cuts_of(values, query, cells);
        const CellMesh mesh = mesh_of(values, query);
        ASSERT_EQ(mesh.vertices.size(), cuts.size());
        for (const MeshVertex& vertex : mesh.vertices)
            EXPECT_TRUE(cuts.contains(edge_of(vertex)));
        open_sides(mesh); // no side twice
    }
}

TEST(CellMesh, InfiniteAndHugeValuesHaveCutsAtTheirFiniteEnds) {
    TestField field({3, 2, 2}, 1, ValueType::f64, [](double, double, double, double) { return 0; });
    for (std::size_t i = 0; i < 12; ++i)
        field.at<double>(0, i) = i % 3 == 0 ? -kInfinity : i % 3 == 1 ? 1e308 : -1e308;
    const CellMesh mesh = mesh_of(field.view(), {Instant(0), 0.0});
    ASSERT_EQ(mesh.vertices.size(), 8u);
    for (const MeshVertex& vertex : mesh.vertices)
        EXPECT_EQ(position_of(vertex).x, vertex.x == 0 ? 1.0 : 1.5);
}

/// The mesh whatever its vertices' numbers are.
std::set<std::array<CutEdge, 3>> triangles_of(const CellMesh& mesh) {
    std::set<std::array<CutEdge, 3>> triangles;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        std::array<CutEdge, 3> edges;
        for (std::size_t k = 0; k < 3; ++k)
            edges[k] = edge_of(mesh.vertices[mesh.triangles[i + k]]);
        std::ranges::rotate(edges, std::ranges::min_element(edges));
        triangles.insert(edges);
    }
    return triangles;
}

/// By one thread where there are few vertices, and by all.
TEST(CellMesh, PartsSideBySideBecomeTheMeshThatOneMakes) {
    std::mt19937 random(test_seed());
    for (const std::array<std::uint32_t, 3> size : {std::array{24u, 25u, 60u}, {48u, 49u, 40u}})
        for (const bool noise : {true, false}) {
            const TestField field(size, 1, ValueType::u8,
                                  noise ? scaled(white_noise(random), 60, 62)
                                        : scaled(turbulence(random), 60, 62));
            const StepValues values = field.view();
            const Query query{Instant(0), 60.5};
            const CellMesh one = mesh_of(values, query);
            for (const std::size_t makers : {2u, 7u})
                EXPECT_TRUE(mesh_of(values, query, makers) == one) << size[0] << " " << noise;
        }
}

TEST(CellMesh, AMakerForgetsTheMeshesBefore) {
    std::mt19937 random(test_seed());
    MeshMaker maker;
    for (int round = 0; round < 30; ++round) {
        const std::array<std::uint32_t, 3> size{2 + std::uint32_t(random() % 9),
                                                2 + std::uint32_t(random() % 9),
                                                2 + std::uint32_t(random() % 9)};
        const TestField field = steps_of(random, size, ValueType::i16);
        const Query query{Instant(0), 4.5};
        const auto cells = active_cells(field.view(), query);
        MeshPart part;
        ASSERT_TRUE(maker.make(field.view(), query, cells, part));
        EXPECT_EQ(part.vertices.size(), cuts_of(field.view(), query, cells).size());
        EXPECT_EQ(triangles_of(part), triangles_of(mesh_of(field.view(), query)));
    }
}

} // namespace
} // namespace isochron::index
