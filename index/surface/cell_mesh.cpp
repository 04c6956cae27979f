// Positions and normals of a mesh's vertices.
#include "index/surface/cell_mesh.h"

#include "index/surface/cell_plane.h"

namespace isochron::index {

glm::dvec3 position_of(const MeshVertex& vertex) {
    glm::dvec3 at(vertex.x, vertex.y, vertex.z);
    at[vertex.axis] += static_cast<double>(vertex.share) / MeshVertex::kWhole;
    return at;
}

std::uint64_t bytes_of(const CellMesh& mesh) {
    return mesh.vertices.size() * sizeof(MeshVertex) +
           mesh.triangles.size() * sizeof(std::uint32_t) + mesh.cases.size() +
           mesh.values.size() * sizeof(float) + mesh.colors.size() * sizeof(std::uint16_t);
}

glm::dvec3 normal_of(const MeshVertex& vertex) {
    if (vertex.normal == MeshVertex::kNoNormal)
        return glm::dvec3(0.0);
    const auto coordinate = [&](unsigned shift) {
        return static_cast<std::int16_t>(vertex.normal >> shift) / double{MeshVertex::kOne};
    };
    return unfolded(coordinate(0), coordinate(16));
}

} // namespace isochron::index
