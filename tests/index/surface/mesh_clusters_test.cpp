// Simplified meshes: their vertices are picked from those of the mesh, one from each cluster, and
// closed surfaces stay closed.
#include "index/surface/mesh_clusters.h"

#include "index/scan/scan.h"
#include "index/surface/mesh_colors.h"
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

double ball_distance(double x, double y, double z) {
    return std::hypot(x - 20.3, y - 19.6, z - 21.1);
}

/// A ball, and a tube that is thinner than the larger clusters, along x.
double ball_and_tube(double x, double y, double z, double) {
    return std::max(12 - ball_distance(x, y, z), 1.7 - std::hypot(y - 36.4, z - 5.7));
}

CellMesh ball_mesh(const TestField& field, std::size_t makers = 1) {
    const Query query{Instant(0), 0.0};
    std::vector<CellId> ids;
    scan(field.view(), query, ids);
    std::vector<MeshMaker> team(makers);
    CellMesh mesh;
    EXPECT_TRUE(make_mesh(team, field.view(), query, ids, mesh));
    return mesh;
}

using ClusterKey = std::array<int, 4>; ///< cube, and the axis of the normal with its sign

ClusterKey cluster_of(const MeshVertex& vertex, int edge) {
    const glm::dvec3 at = position_of(vertex), n = normal_of(vertex);
    int axis = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(n[i]) > std::abs(n[axis]))
            axis = i;
    return {int(at.x) / edge, int(at.y) / edge, int(at.z) / edge, n[axis] < 0 ? -axis - 1 : axis};
}

class MeshClusters : public testing::Test {
  protected:
    TestField field_{{41, 42, 43}, 1, ValueType::f32, ball_and_tube};
    CellMesh mesh_ = ball_mesh(field_);
};

TEST_F(MeshClusters, HaveOneVertexOfTheMeshEachAndTrianglesWhereThreeMeet) {
    for (const int edge : {1, 2, 4, 8}) {
        const CellMesh fewer = clustered(mesh_, static_cast<std::uint32_t>(edge));
        std::set<std::array<std::uint32_t, 4>> vertices;
        for (const MeshVertex& v : mesh_.vertices)
            vertices.insert({v.x, v.y, v.z, v.axis});
        std::set<ClusterKey> clusters;
        for (const MeshVertex& v : fewer.vertices) {
            EXPECT_TRUE(vertices.contains({v.x, v.y, v.z, v.axis}));
            EXPECT_TRUE(clusters.insert(cluster_of(v, edge)).second) << "two of a cluster";
        }
        std::multiset<std::array<ClusterKey, 3>> wanted, made;
        const auto add = [&](const CellMesh& mesh, auto& to) {
            for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
                std::array<ClusterKey, 3> of;
                for (std::size_t k = 0; k < 3; ++k)
                    of[k] = cluster_of(mesh.vertices[mesh.triangles[i + k]], edge);
                if (of[0] != of[1] && of[1] != of[2] && of[2] != of[0])
                    to.insert(of);
            }
        };
        add(mesh_, wanted);
        add(fewer, made);
        EXPECT_EQ(made, wanted);
        EXPECT_EQ(made.size(), fewer.triangles.size() / 3);
        if (edge > 1) {
            EXPECT_LT(fewer.triangles.size() * edge, mesh_.triangles.size() * 5 / 4) << edge;
        }
    }
}

TEST_F(MeshClusters, OfAClosedSurfaceAreClosed) {
    const TestField ball({41, 42, 43}, 1, ValueType::f32, [](double x, double y, double z, double) {
        return 12 - ball_distance(x, y, z);
    });
    const CellMesh closed = ball_mesh(ball);
    for (const std::uint32_t edge : {2, 4, 8}) {
        const CellMesh fewer = clustered(closed, edge);
        std::map<std::array<std::uint32_t, 2>, int> uses; // uses of each side of a triangle
        for (std::size_t i = 0; i < fewer.triangles.size(); ++i) {
            const std::uint32_t a = fewer.triangles[i],
                                b = fewer.triangles[i % 3 == 2 ? i - 2 : i + 1];
            ++uses[{std::min(a, b), std::max(a, b)}];
        }
        ASSERT_GT(uses.size(), 30u);
        for (const auto& [side, count] : uses)
            EXPECT_EQ(count % 2, 0) << "a border at " << side[0] << " to " << side[1];
    }
}

TEST_F(MeshClusters, LieOnTheSurfaceAndKeepThinThings) {
    for (const std::uint32_t edge : {2, 4}) {
        const CellMesh fewer = clustered(mesh_, edge);
        std::size_t of_tube = 0;
        for (std::size_t i = 0; i < fewer.triangles.size(); i += 3) {
            glm::dvec3 middle(0);
            for (std::size_t k = 0; k < 3; ++k)
                middle += position_of(fewer.vertices[fewer.triangles[i + k]]) / 3.0;
            if (middle.y > 33) {
                ++of_tube;
                continue;
            }
            const double inside = 12 - ball_distance(middle.x, middle.y, middle.z);
            EXPECT_LT(std::abs(inside), edge * edge / 12.0) << "where it bends away from a chord";
        }
        EXPECT_GT(of_tube, 8u * 40 / edge) << "a tube has sides";
    }
}

TEST_F(MeshClusters, AreTheSameForMeshesMadeWithAnyNumberOfThreads) {
    const CellMesh other = ball_mesh(field_, 7);
    EXPECT_EQ(other, mesh_);
    EXPECT_EQ(clustered(other, 2), clustered(mesh_, 2));
}

TEST_F(MeshClusters, KeepTheColorsOfTheirVertices) {
    CellMesh colored = mesh_;
    for (std::size_t i = 0; i < colored.vertices.size(); ++i)
        colored.colors.push_back(static_cast<std::uint16_t>(i));
    const CellMesh fewer = clustered(colored, 4);
    ASSERT_EQ(fewer.colors.size(), fewer.vertices.size());
    for (std::size_t i = 0; i < fewer.vertices.size(); ++i)
        EXPECT_EQ(colored.vertices[fewer.colors[i]], fewer.vertices[i]);
}

TEST_F(MeshClusters, AreNoneOfAnEmptyMeshOrWhenStopped) {
    EXPECT_EQ(clustered({}, 4), CellMesh());
    std::stop_source stop;
    stop.request_stop();
    EXPECT_EQ(clustered(mesh_, 4, stop.get_token()), CellMesh());
}

TEST(MeshColors, OfValuesAreTheirPlacesInTheRange) {
    CellMesh mesh;
    mesh.values = {-1, 0, 2.5, 10, 11, std::nanf(""), INFINITY};
    color_by_values(mesh, 0, 10);
    EXPECT_EQ(mesh.colors, (std::vector<std::uint16_t>{0, 0, 16384, 65534, 65534, 65535, 65535}));
    EXPECT_TRUE(mesh.values.empty());
}

TEST_F(MeshClusters, OfCellsWithOneColorHaveThatColor) {
    CellMesh colored = mesh_;
    color_by_cells(colored, std::vector<std::uint16_t>(mesh_.cases.size(), 819));
    EXPECT_EQ(std::set(colored.colors.begin(), colored.colors.end()),
              std::set<std::uint16_t>{6553});
    std::vector<std::uint16_t> colors(mesh_.cases.size(), 8191);
    colors[0] = 8190; // the first cell's vertices are its own
    color_by_cells(colored, colors);
    EXPECT_EQ(colored.colors[colored.triangles[0]], 65534);
    EXPECT_EQ(colored.colors.back(), 65535);
}

} // namespace
} // namespace isochron::index
