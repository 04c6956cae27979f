// Simplifies the mesh of a surface: one vertex for all vertices that lie together.
//
//     const index::CellMesh fewer = index::clustered(mesh, 2, stop);   // clusters of 2 x 2 x 2 cells
#pragma once

#include "index/surface/cell_mesh.h"

#include <cstdint>
#include <stop_token>

namespace isochron::index {

/// Vertices whose places lie in the same cube of the grid, and whose normals are longest along the
/// same direction of an axis, are a cluster. Of each cluster that vertex stays which is nearest to the
/// planes of all triangles around the cluster (the least quadric error: M. Garland and P. Heckbert
/// 1997, doi:10.1145/258734.258849), with its own place, normal and color. Triangles stay whose
/// vertices are in three clusters. Cubes lie alike in the whole grid, so meshes that are
/// simplified in parts have no cracks between them. Two sides of a thin thing stay apart, as their
/// normals differ.
/// @param edge of the cubes [cells], at least 1
/// @return a mesh without `cases` and `values`; empty when stopped
CellMesh clustered(const CellMesh& mesh, std::uint32_t edge, const std::stop_token& stop = {});

} // namespace isochron::index
