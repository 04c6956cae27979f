// Crops a mesh that is exported: to a box, or to the corners that a function keeps.
#pragma once

#include "index/surface/cell_mesh.h"

#include <array>
#include <cstdint>
#include <functional>

namespace isochron::index {

/// A box of vertices of the grid, both ends included.
struct VertexBox {
    std::array<std::uint32_t, 3> first{}, last{}; ///< x, y, z
};

/// Removes the triangles with a corner outside of the box, and the vertices that no triangle uses
/// then. The others keep their order; `cases` stay those of all cells.
void crop(CellMesh& mesh, const VertexBox& box);

/// Removes triangles with a corner that is not to be kept, and vertices that none is left to use.
/// What stays keeps its order, as in `crop`.
void keep_triangles(CellMesh& mesh, const std::function<bool(const MeshVertex& corner)>& keeps);

/// Removes vertices that no triangle uses.
void drop_unused_vertices(CellMesh& mesh);

} // namespace isochron::index
