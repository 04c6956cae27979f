// The connected pieces of a surface mesh, and its border.
#pragma once

#include "index/file/index_file.h"
#include "index/surface/cell_mesh.h"
#include "index/volume/grid.h"

#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// Two triangles are in one piece if they share an edge, or are joined by a chain of such triangles.
struct MeshPieces {
    std::uint32_t count = 0;
    std::vector<std::uint32_t> of_triangle; ///< the piece of each triangle, numbered as they come
    /// Edges of each piece that only one triangle has: where the surface leaves the grid, or meets a
    /// cell with a missing value.
    std::vector<std::uint32_t> border_edges;
};

/// Whether all values of all steps are finite numbers.
bool is_complete(const IndexFile& file);

/// @param complete whether the mesh is of all active cells of a step in which no value is missing:
///        then vertices tell what the edges would, in a tenth of the time
MeshPieces pieces_of(const CellMesh& mesh, const Grid& grid, bool complete);
/// @param corners of triangles, three each
MeshPieces pieces_of(std::span<const std::uint32_t> corners);

} // namespace isochron::index
