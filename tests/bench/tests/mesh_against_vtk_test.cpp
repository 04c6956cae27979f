// The mesh of a cell set is that of VTK's flying edges: the same cut edges, the same polygons.
#include "index/scan/scan.h"
#include "index/surface/mesh_parts.h"
#include "tests/bench/rivals/flying_edges.h"
#include "tests/support/test_field.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace isochron::bench {
namespace {

using index::TestField;
using index::ValueType;

/// The lower end of an edge, and its axis.
using Edge = std::array<int, 4>;
using Cell = std::array<int, 3>;
/// From one cut edge to the next, along a side of a polygon.
using Side = std::pair<Edge, Edge>;

/// Which edge a point of VTK lies on where no cut is near a vertex of the grid.
Edge edge_of(const glm::vec3& point) {
    Edge edge{};
    float farthest = -1;
    for (int axis = 0; axis < 3; ++axis) {
        const float off = std::abs(point[axis] - std::round(point[axis]));
        if (off <= farthest)
            continue;
        farthest = off;
        edge[3] = axis;
    }
    for (int axis = 0; axis < 3; ++axis)
        edge[static_cast<std::size_t>(axis)] =
            static_cast<int>(axis == edge[3] ? std::floor(point[axis]) : std::round(point[axis]));
    return edge;
}

Edge edge_of(const index::MeshVertex& vertex) {
    return {vertex.x, vertex.y, vertex.z, vertex.axis};
}

/// The cell that a triangle lies in.
Cell cell_of(const std::array<Edge, 3>& edges) {
    Cell cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        int least = edges[0][axis], most = least;
        for (const Edge& edge : edges) {
            least = std::min(least, edge[axis]);
            most = std::max(most, edge[axis] + (edge[3] == static_cast<int>(axis) ? 1 : 0));
        }
        EXPECT_LE(most - least, 1);
        cell[axis] = least;
    }
    return cell;
}

/// Sides of the polygons of each cell, which are what its triangles leave unpaired.
std::map<Cell, std::set<Side>> polygons(const std::vector<std::array<Edge, 3>>& triangles) {
    std::map<Cell, std::set<Side>> sides;
    for (const auto& triangle : triangles) {
        std::set<Side>& of_cell = sides[cell_of(triangle)];
        for (std::size_t i = 0; i < 3; ++i) {
            const Edge &from = triangle[i], &to = triangle[(i + 1) % 3];
            if (of_cell.erase({to, from}) == 0)
                of_cell.insert({from, to});
        }
    }
    return sides;
}

template <class Vertices, class Numbers>
std::vector<std::array<Edge, 3>> triangles_of(const Vertices& vertices, const Numbers& numbers,
                                              std::size_t count) {
    std::vector<std::array<Edge, 3>> triangles(count);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            triangles[i][k] = edge_of(vertices[numbers(i, k)]);
    return triangles;
}

index::CellMesh mesh_of(const index::StepValues& values, const index::Query& query,
                        std::size_t makers = 1) {
    std::vector<index::CellId> cells;
    index::scan(values, query, cells);
    std::vector<index::MeshMaker> team(makers);
    index::CellMesh mesh;
    EXPECT_TRUE(make_mesh(team, values, query, cells, mesh));
    return mesh;
}

/// @param isovalue that no value comes near to
void expect_same(const index::StepValues& values, double isovalue) {
    SCOPED_TRACE(isovalue);
    const index::Query query{index::Instant(0), isovalue};
    const auto rival = flying_edges(values)->geometry(query);
    const index::CellMesh mesh = mesh_of(values, query);
    std::map<Edge, glm::dvec3> theirs;
    std::map<Edge, glm::vec3> their_normals;
    for (std::size_t i = 0; i < rival.points.size(); ++i) {
        theirs[edge_of(rival.points[i])] = rival.points[i];
        their_normals[edge_of(rival.points[i])] = rival.normals[i];
    }
    ASSERT_EQ(mesh.vertices.size(), theirs.size());
    for (const index::MeshVertex& vertex : mesh.vertices) {
        const auto found = theirs.find(edge_of(vertex));
        ASSERT_NE(found, theirs.end());
        EXPECT_LT(glm::distance(found->second, index::position_of(vertex)), 1e-5);
        const glm::dvec3 normal = their_normals.at(edge_of(vertex));
        const bool has_one = glm::length(normal) > 0.5;
        EXPECT_TRUE(!has_one || glm::dot(normal, index::normal_of(vertex)) > 1 - 1e-6);
    }
    const auto ours = triangles_of(
        mesh.vertices, [&](std::size_t i, std::size_t k) { return mesh.triangles[3 * i + k]; },
        mesh.triangles.size() / 3);
    const auto vtks = triangles_of(
        rival.points, [&](std::size_t i, std::size_t k) { return rival.triangles[i][k]; },
        rival.triangles.size());
    EXPECT_EQ(ours.size(), vtks.size());
    EXPECT_EQ(polygons(ours), polygons(vtks));
}

TEST(MeshAgainstVtk, AllWaysToLieAmongTheVerticesOfACell) {
    for (unsigned upper = 1; upper < 255; ++upper) {
        SCOPED_TRACE(upper);
        const TestField field({2, 2, 2}, 1, ValueType::f32,
                              [&](double x, double y, double z, double) {
                                  return upper >> int(x + 2 * y + 4 * z) & 1 ? 1.0 : 0.0;
                              });
        expect_same(field.view(), 0.4);
    }
}

TEST(MeshAgainstVtk, NoiseOfEveryTypeInGridsDownToOneCell) {
    std::mt19937 random(test_seed());
    for (const ValueType type : index::kAllTypes)
        for (const std::array<std::uint32_t, 3> size :
             {std::array{2u, 2u, 2u}, std::array{2u, 9u, 3u}, std::array{13u, 2u, 2u},
              std::array{3u, 2u, 11u}, std::array{12u, 13u, 11u}}) {
            SCOPED_TRACE(index::name_of(type));
            // Whole numbers in all types: isovalues between them never tie.
            const TestField field(size, 1, type, index::scaled(index::white_noise(random), 60, 62));
            for (const double isovalue : {20.5, 60.25, 97.75})
                expect_same(field.view(), std::nextafter(isovalue, 0));
        }
}

TEST(MeshAgainstVtk, SmoothFieldsWithAnisotropicSpacing) {
    std::mt19937 random(test_seed());
    for (const ValueType type : {ValueType::u8, ValueType::i16, ValueType::f32, ValueType::f64}) {
        const TestField field({31, 24, 27}, 1, type,
                              index::scaled(index::turbulence(random), 60, 62));
        index::StepValues values = field.view();
        values.grid.spacing = {0.5, 2.0, 1.25};
        expect_same(values, 66.3);
    }
}

} // namespace
} // namespace isochron::bench
