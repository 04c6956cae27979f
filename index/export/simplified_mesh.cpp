// Takes triangles from a surface, and measures how far it has moved.
#include "index/export/simplified_mesh.h"

#include "index/export/edge_collapse.h"
#include "index/export/mesh_distance.h"
#include "index/surface/mesh_crop.h"

#include <algorithm>

namespace isochron::index {
namespace {

constexpr std::size_t kMostTries = 24;
constexpr double kFirstLimit = 0.95; ///< leaves room between the bounds of the distance

/// Adds the neighbors of points.
void grow(std::vector<bool>& points, const PlainMesh& mesh) {
    const std::vector<bool> before = points;
    for (const auto& [a, b, c] : mesh.triangles)
        if (before[a] || before[b] || before[c])
            points[a] = points[b] = points[c] = true;
}

/// Lowers the limits of all points where much of the mesh lies beyond the most, else of those beyond it,
/// and of ever more around them.
void lower_limits(std::vector<double>& limits, const PlainMesh& all, const PlainMesh& fewer,
                  const FarthestPoint& there, const FarthestPoint& back, std::size_t tries) {
    constexpr std::size_t kFew = 50; // one in so many triangles
    constexpr double kAll = 0.9, kSome = 0.5;
    if (tries < kMostTries / 2 && back.beyond.size() * kFew > fewer.triangles.size()) {
        for (double& limit : limits)
            limit *= kAll;
        return;
    }
    std::vector<bool> held(limits.size());
    for (const auto* const triangles : {&there.beyond, &back.nearest})
        for (const std::uint32_t triangle : *triangles)
            for (const std::uint32_t corner : all.triangles[triangle])
                held[corner] = true;
    for (std::size_t ring = 0; ring < tries / 4; ++ring)
        grow(held, all);
    for (std::size_t point = 0; point < held.size(); ++point)
        if (held[point])
            limits[point] = tries < kMostTries / 2 ? kSome * limits[point] : 0;
}

} // namespace

double simplify(CellMesh& mesh, const Grid& grid, double most, const std::function<void()>& look) {
    if (mesh.triangles.empty())
        return 0;
    PlainMesh all;
    all.points.reserve(mesh.vertices.size());
    for (const MeshVertex& vertex : mesh.vertices)
        all.points.push_back(grid.physical(position_of(vertex)) - grid.origin);
    for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3)
        all.triangles.push_back({mesh.triangles[i], mesh.triangles[i + 1], mesh.triangles[i + 2]});
    const NearestTriangle near_all(all);
    const auto looking = [&](double) {
        if (look)
            look();
    };
    PlainMesh fewer;
    std::vector<double> limits(all.points.size(), kFirstLimit * most);
    double moved = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < kMostTries && moved > most; ++i) {
        fewer = all;
        collapse_edges(fewer, limits, look);
        const DistanceWishes wishes{.most = most, .negligible = most / 100};
        const FarthestPoint there = farthest_from(all, NearestTriangle(fewer), wishes, looking);
        const FarthestPoint back = farthest_from(
            fewer, near_all, {most, std::min(there.lower, most), wishes.negligible}, looking);
        moved = std::max(there.upper, back.upper);
        if (moved > most)
            lower_limits(limits, all, fewer, there, back, i);
    }
    if (moved > most) // as it was
        return 0;
    mesh.triangles.clear();
    for (const auto& triangle : fewer.triangles)
        mesh.triangles.insert(mesh.triangles.end(), triangle.begin(), triangle.end());
    drop_unused_vertices(mesh);
    return moved;
}

double shortest_side(const Grid& grid) {
    double shortest = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const auto number = static_cast<std::size_t>(axis);
        const std::vector<double>& places = grid.positions[number].distances();
        if (places.empty())
            shortest = std::min(shortest, grid.spacing[axis]);
        for (std::size_t i = 1; i < places.size(); ++i)
            shortest = std::min(shortest, places[i] - places[i - 1]);
    }
    return shortest;
}

} // namespace isochron::index
