// Sorts triangles by the coordinate of their cells, by counting.
#include "render/drawing/mesh_order.h"

#include "index/surface/mesh_cases.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace isochron::render {
namespace {

/// Makes of the number of triangles in each plane the place of its first triangle.
void make_places(std::vector<std::uint32_t>& planes, bool descending, std::size_t first) {
    auto before = static_cast<std::uint32_t>(first);
    for (std::size_t i = 0; i < planes.size(); ++i) {
        std::uint32_t& plane = planes[descending ? planes.size() - 1 - i : i];
        before += std::exchange(plane, before);
    }
}

} // namespace

PlaneOrder near_planes_first(const glm::vec4& eye, const glm::vec3& extent,
                             const glm::vec3& spacing) {
    PlaneOrder order;
    float most = -1.0f;
    for (int axis = 0; axis < 3; ++axis) {
        const float ahead = (eye[axis] - eye.w * 0.5f * extent[axis]) * spacing[axis];
        if (std::abs(ahead) > most) {
            most = std::abs(ahead);
            order = {axis, ahead > 0.0f};
        }
    }
    return order;
}

void append_in_order(std::span<const CellPlace> cells, const index::CellMesh& mesh,
                     PlaneOrder order, std::vector<std::uint32_t>& corners) {
    const std::array<std::uint16_t CellPlace::*, 3> coordinates{&CellPlace::x, &CellPlace::y,
                                                                &CellPlace::z};
    const auto coordinate = coordinates[static_cast<std::size_t>(order.axis)];
    std::uint32_t planes = 0;
    for (const CellPlace& cell : cells)
        planes = std::max(planes, cell.*coordinate + 1u);
    const std::array<index::MeshCase, 256>& cases = index::mesh_cases();
    std::vector<std::uint32_t> next(planes); // triangles of each plane
    for (std::size_t i = 0; i < cells.size(); ++i)
        next[cells[i].*coordinate] += cases[mesh.cases[i]].triangles;
    make_places(next, order.descending, corners.size() / 3);
    corners.resize(corners.size() + mesh.triangles.size());
    const std::uint32_t* from = mesh.triangles.data();
    for (std::size_t i = 0; i < cells.size(); ++i) {
        std::uint32_t& at = next[cells[i].*coordinate];
        const std::uint32_t count = cases[mesh.cases[i]].triangles;
        std::uint32_t* const to = corners.data() + std::size_t{3} * at;
        for (std::size_t k = 0; k < std::size_t{3} * count; ++k)
            to[k] = from[k];
        from += std::size_t{3} * count;
        at += count;
    }
}

void append_in_order(const index::CellMesh& mesh, PlaneOrder order,
                     std::vector<std::uint32_t>& corners) {
    const std::array<std::uint16_t index::MeshVertex::*, 3> coordinates{
        &index::MeshVertex::x, &index::MeshVertex::y, &index::MeshVertex::z};
    const auto coordinate = coordinates[static_cast<std::size_t>(order.axis)];
    std::uint32_t planes = 0;
    for (const index::MeshVertex& vertex : mesh.vertices)
        planes = std::max(planes, vertex.*coordinate + 1u);
    std::vector<std::uint32_t> next(planes);
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
        ++next[mesh.vertices[mesh.triangles[i]].*coordinate];
    make_places(next, order.descending, corners.size() / 3);
    corners.resize(corners.size() + mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
        std::copy_n(
            &mesh.triangles[i], 3,
            &corners[std::size_t{3} * next[mesh.vertices[mesh.triangles[i]].*coordinate]++]);
}

std::vector<std::uint32_t> far_first(std::span<const index::CellMeshPtr> meshes,
                                     std::span<const std::size_t> first_vertices,
                                     const glm::vec4& ahead) {
    std::vector<float> distances; // distance of each triangle
    std::vector<std::uint32_t> corners;
    for (std::size_t i = 0; i < meshes.size(); ++i)
        for (std::size_t k = 0; meshes[i] && k < meshes[i]->triangles.size(); ++k) {
            const std::uint32_t number = meshes[i]->triangles[k];
            corners.push_back(static_cast<std::uint32_t>(first_vertices[i] + number));
            if (k % 3 == 0) {
                const index::MeshVertex& vertex = meshes[i]->vertices[number];
                const glm::vec4 at(vertex.x, vertex.y, vertex.z, 1.0f);
                distances.push_back(glm::dot(at, ahead));
            }
        }
    return far_first(distances, corners);
}

std::vector<std::uint32_t> far_first(std::span<const float> distances,
                                     std::span<const std::uint32_t> corners) {
    if (distances.empty())
        return {};
    const auto [least, most] = std::ranges::minmax(distances);
    constexpr float kPlaces = 1 << 14;
    const float scale = most > least ? (kPlaces - 1) / (most - least) : 0.0f;
    std::vector<std::uint32_t> next(static_cast<std::size_t>(kPlaces));
    const auto place = [&, first = least](float distance) {
        return static_cast<std::size_t>(scale * (distance - first));
    };
    for (const float distance : distances)
        ++next[place(distance)];
    make_places(next, true, 0);
    std::vector<std::uint32_t> ordered(corners.size());
    for (std::size_t i = 0; i < distances.size(); ++i)
        std::copy_n(&corners[3 * i], 3, &ordered[std::size_t{3} * next[place(distances[i])]++]);
    return ordered;
}

} // namespace isochron::render
