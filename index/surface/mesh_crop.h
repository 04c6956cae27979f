// Crops a mesh: to the cells of a box, or to the corners that a function keeps.
#pragma once

#include "index/surface/cell_mesh.h"

#include <array>
#include <cstdint>
#include <functional>

namespace isochron::index {

/// A box of vertices of the grid, both ends included.
struct VertexBox {
    std::array<std::uint32_t, 3> first{}, last{}; ///< x, y, z
    bool operator==(const VertexBox&) const = default;
};

bool is_within(const MeshVertex& vertex, const VertexBox& box);

/// Removes triangles with a corner that is not to be kept, the vertices that none is left to use, and the
/// cases of cells that have none left. What stays keeps its order.
/// @param mesh as it was made: all triangles of its cases
void keep_triangles(CellMesh& mesh, const std::function<bool(const MeshVertex& corner)>& keeps);

/// Removes vertices that no triangle uses.
void drop_unused_vertices(CellMesh& mesh);

} // namespace isochron::index
