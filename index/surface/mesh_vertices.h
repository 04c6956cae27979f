// Computes the positions of a mesh's vertices on their edges, and their normals.
#pragma once

#include "index/surface/cell_mesh.h"
#include "index/volume/query.h"
#include "index/volume/step_values.h"

#include <span>

namespace isochron::index {

/// Fills `share` and `normal` of vertices on cut edges.
/// @param first_plane z in the grid of the first plane of `values`; the vertices' z is in the grid
void place_vertices(const StepValues& values, const Query& query, std::uint32_t first_plane,
                    std::span<MeshVertex> vertices);

} // namespace isochron::index
