// Removes triangles and the vertices that no other triangle uses.
#include "index/surface/mesh_crop.h"

#include "index/surface/mesh_cases.h"

#include <limits>

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
    std::vector<bool> within(mesh.vertices.size());
    for (std::size_t i = 0; i < within.size(); ++i)
        within[i] = keeps(mesh.vertices[i]);
    std::size_t kept = 0, kept_cells = 0, next = 0;
    for (const std::uint8_t which : mesh.cases) {
        const std::size_t before = kept;
        for (const std::size_t end = next + 3u * mesh_cases()[which].triangles; next < end;
             next += 3) {
            if (!within[mesh.triangles[next]] || !within[mesh.triangles[next + 1]] ||
                !within[mesh.triangles[next + 2]])
                continue;
            for (std::size_t corner = 0; corner < 3; ++corner)
                mesh.triangles[kept + corner] = mesh.triangles[next + corner];
            kept += 3;
        }
        if (kept > before)
            mesh.cases[kept_cells++] = which;
    }
    mesh.triangles.resize(kept);
    mesh.cases.resize(kept_cells);
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
