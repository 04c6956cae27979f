// Parts of meshes that are exported: those within a box, and those that triangles still use.
#pragma once

#include "index/surface/cell_mesh.h"

#include <array>
#include <cstdint>
#include <functional>

namespace isochron::index {

/// Vertices of the grid along each axis, both ends included.
struct VertexBox {
    std::array<std::uint32_t, 3> first{}, last{}; ///< x, y, z
};

/// Removes triangles with a corner outside of the box, and vertices that none is left to use. What
/// stays keeps its order. `cases` are those of all cells still.
void crop(CellMesh& mesh, const VertexBox& box);

/// Removes triangles with a corner that is not to be kept, and vertices that none is left to use.
/// What stays keeps its order, as in `crop`.
void keep_triangles(CellMesh& mesh, const std::function<bool(const MeshVertex& corner)>& keeps);

/// Removes vertices that no triangle uses.
void drop_unused_vertices(CellMesh& mesh);

} // namespace isochron::index
