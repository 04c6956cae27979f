// The polygons of an isosurface in one cell, for each of the 256 ways to lie among its vertices.
#pragma once

#include <array>
#include <cstdint>

namespace isochron::index {

/// Edges of a cell: 4 a + u + 2 v is the edge along axis a that starts at offsets u and v along the
/// other two axes, in their order.
constexpr int kCellEdges = 12;

/// What a surface does in a cell whose vertices 4 z + 2 y + x, as bits, are on its upper side.
struct MeshCase {
    static constexpr int kMostTriangles = 5;
    std::uint16_t cut = 0;      ///< a bit for each edge with ends on both sides
    std::uint8_t triangles = 0; ///< 0 to kMostTriangles
    /// Three edges each; counter-clockwise for who looks from the side of lower values.
    std::array<std::uint8_t, 3 * kMostTriangles> edges{};
};

/// By the bits of the vertices on the upper side. The polygons are those of marching cubes
/// (Lorensen and Cline, 1987, doi:10.1145/37402.37422) as VTK has them: on a face with four cut
/// edges each of the two upper vertices is cut off on its own. No side of a triangle lies in a face
/// of the cell but those of the polygons, so neighbors fit.
const std::array<MeshCase, 256>& mesh_cases();

} // namespace isochron::index
