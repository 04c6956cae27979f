// Where the vertices of a mesh lie on their edges, and their normals.
#pragma once

#include "index/extraction/cell_mesh.h"
#include "index/volume/query.h"
#include "index/volume/step_values.h"

#include <span>

namespace isochron::index {

/// Fills `share` and `normal` of vertices on cut edges.
/// @param first_plane of `values`, from which the vertices' z counts
void place_vertices(const StepValues& values, const Query& query, std::uint32_t first_plane,
                    std::span<MeshVertex> vertices);

} // namespace isochron::index
