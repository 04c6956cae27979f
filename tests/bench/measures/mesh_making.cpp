#include "tests/bench/measures/mesh_making.h"

#include "index/error.h"
#include "index/surface/mesh_parts.h"
#include "tests/bench/measures/timing.h"
#include "tests/bench/rivals/flying_edges.h"

#include <array>

namespace isochron::bench {

MeshMaking measure_mesh_making(const index::StepValues& values, const index::Query& query,
                               std::span<const index::CellId> ids) {
    const auto rival = flying_edges(values);
    std::array<index::MeshMaker, 1> makers;
    index::CellMesh mesh;
    FlyingEdges::Surface theirs{};
    const auto seconds =
        time_in_turn({[&](std::uint32_t) { index::make_mesh(makers, values, query, ids, mesh); },
                      [&](std::uint32_t) { theirs = rival->contour(query, true); }},
                     1, 9);
    const std::size_t triangles = mesh.triangles.size() / 3;
    if (theirs.triangles != triangles)
        throw index::Error("flying edges make {} triangles, the mesh has {}", theirs.triangles,
                           triangles);
    return {.seconds = seconds[0], .seconds_of_vtk = seconds[1], .triangles = triangles};
}

} // namespace isochron::bench
