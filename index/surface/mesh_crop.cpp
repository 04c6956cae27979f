// Removes triangles and the vertices that no other triangle uses.
#include "index/surface/mesh_crop.h"

#include "index/surface/mesh_cases.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace isochron::index {
bool is_within(const MeshVertex& vertex, const VertexBox& box) {
    const glm::dvec3 at = position_of(vertex);
    for (int axis = 0; axis < 3; ++axis)
        if (at[axis] < box.first[static_cast<std::size_t>(axis)] ||
            at[axis] > box.last[static_cast<std::size_t>(axis)])
            return false;
    return true;
}

void keep_triangles(CellMesh& mesh, const std::function<bool(const MeshVertex& corner)>& keeps) {
    std::vector<std::uint8_t> within, kept;
    within.reserve(mesh.vertices.size());
    for (const MeshVertex& vertex : mesh.vertices)
        within.push_back(keeps(vertex));
    kept.reserve(mesh.triangles.size() / 3);
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
        kept.push_back(within[mesh.triangles[i]] & within[mesh.triangles[i + 1]] &
                       within[mesh.triangles[i + 2]]);
    keep_triangles(mesh, kept);
}

void keep_triangles(CellMesh& mesh, std::span<const std::uint8_t> kept) {
    std::array<std::uint8_t, MeshCase::kMostTriangles + 1> case_of{}; // by number of triangles
    for (std::size_t i = 0; i < mesh_cases().size(); ++i)
        case_of[mesh_cases()[i].triangles] = static_cast<std::uint8_t>(i);
    std::size_t corners = 0, cells = 0, next = 0;
    for (const std::uint8_t which : mesh.cases) {
        const std::uint8_t before = mesh_cases()[which].triangles;
        std::uint8_t left = 0;
        for (const std::size_t end = next + before; next < end; ++next) {
            if (kept[next] == 0)
                continue;
            for (std::size_t corner = 0; corner < 3; ++corner)
                mesh.triangles[corners++] = mesh.triangles[3 * next + corner];
            ++left;
        }
        if (left > 0)
            mesh.cases[cells++] = left == before ? which : case_of[left];
    }
    mesh.triangles.resize(corners);
    mesh.cases.resize(cells);
    drop_unused_vertices(mesh);
}

void drop_unused_vertices(CellMesh& mesh) {
    constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> places(mesh.vertices.size(), kUnused);
    for (const std::uint32_t corner : mesh.triangles)
        places[corner] = 0;
    std::uint32_t kept = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (places[i] == kUnused)
            continue;
        places[i] = kept;
        mesh.vertices[kept] = mesh.vertices[i];
        if (!mesh.values.empty())
            mesh.values[kept] = mesh.values[i];
        if (!mesh.colors.empty())
            mesh.colors[kept] = mesh.colors[i];
        ++kept;
    }
    mesh.vertices.resize(kept);
    if (!mesh.values.empty())
        mesh.values.resize(kept);
    if (!mesh.colors.empty())
        mesh.colors.resize(kept);
    for (std::uint32_t& corner : mesh.triangles)
        corner = places[corner];
}

} // namespace isochron::index
