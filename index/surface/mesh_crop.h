// Crops a mesh: to the cells of a box, or to the corners that a function keeps.
#pragma once

#include "index/surface/cell_mesh.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>

namespace isochron::index {

/// A box of vertices of the grid, both ends included.
struct VertexBox {
    std::array<std::uint32_t, 3> first{}, last{}; ///< x, y, z
    bool operator==(const VertexBox&) const = default;
};

bool is_within(const MeshVertex& vertex, const VertexBox& box);

/// Removes triangles, and vertices that no triangle uses any more. A cell that has no triangle left loses
/// its case; a cell with some left gets a case of that many. What stays keeps its order.
/// @param kept for each triangle, 0: it goes
void keep_triangles(CellMesh& mesh, std::span<const std::uint8_t> kept);
/// Removes the triangles of which `keeps` refuses a corner.
void keep_triangles(CellMesh& mesh, const std::function<bool(const MeshVertex& corner)>& keeps);

/// Removes vertices that no triangle uses.
void drop_unused_vertices(CellMesh& mesh);

} // namespace isochron::index
