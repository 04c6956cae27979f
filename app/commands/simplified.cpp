// Surfaces with fewer triangles, by meshoptimizer.
#include "app/commands/simplified.h"

#include "index/export/mesh_crop.h"

#include <glm/vec3.hpp>

#include <vector>

#ifdef ISOCHRON_WITH_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

namespace isochron::app {

bool can_simplify() {
#ifdef ISOCHRON_WITH_MESHOPTIMIZER
    return true;
#else
    return false;
#endif
}

double simplify([[maybe_unused]] index::CellMesh& mesh, [[maybe_unused]] const index::Grid& grid,
                [[maybe_unused]] double error) {
    float moved = 0;
    double scale = 0;
#ifdef ISOCHRON_WITH_MESHOPTIMIZER
    if (mesh.triangles.empty())
        return 0;
    std::vector<glm::vec3> places;
    places.reserve(mesh.vertices.size());
    for (const index::MeshVertex& vertex : mesh.vertices)
        places.emplace_back(grid.physical(position_of(vertex)) - grid.origin);
    const float* const first = &places.front().x;
    scale = meshopt_simplifyScale(first, places.size(), sizeof(glm::vec3));
    std::vector<std::uint32_t> fewer(mesh.triangles.size());
    const std::size_t count = meshopt_simplify(
        fewer.data(), mesh.triangles.data(), mesh.triangles.size(), first, places.size(),
        sizeof(glm::vec3), 0, static_cast<float>(error / scale), 0, &moved);
    fewer.resize(count);
    mesh.triangles = std::move(fewer);
    drop_unused_vertices(mesh);
#endif
    return double{moved} * scale;
}

} // namespace isochron::app
