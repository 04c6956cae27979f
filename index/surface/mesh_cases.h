// The triangles of an isosurface in one cell, for each of the 256 cases of its vertices' sides.
#pragma once

#include <array>
#include <cstdint>

namespace isochron::index {

/// Edges of a cell: 4 a + u + 2 v is the edge along axis a that starts at offsets u and v along the
/// other two axes, in their order.
constexpr int kCellEdges = 12;

/// The surface in a cell, for one set of vertices on its upper side.
struct MeshCase {
    static constexpr int kMostTriangles = 5;
    std::uint16_t cut = 0;      ///< a bit for each edge whose ends are on different sides
    std::uint8_t triangles = 0; ///< 0 to kMostTriangles
    /// Three edges for each triangle, counter-clockwise as seen from the side of lower values.
    std::array<std::uint8_t, 3 * kMostTriangles> edges{};
};

/// All cases, by the bits of the vertices on the upper side: bit 4 z + 2 y + x. The polygons are
/// the ones of marching cubes (Lorensen and Cline, 1987, doi:10.1145/37402.37422) as in VTK: on a
/// face with four cut edges, each of the two upper vertices is cut off separately. Sides of
/// triangles lie in a face of the cell only if they are sides of the polygon, so neighboring cells
/// fit together.
const std::array<MeshCase, 256>& mesh_cases();

} // namespace isochron::index
