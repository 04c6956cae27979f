// What a filter of connected pieces leaves of a surface.
#pragma once

#include "index/measure/mesh_pieces.h"
#include "index/surface/cell_mesh.h"
#include "index/volume/grid.h"
#include "index/volume/query.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// Pieces are those of mesh_pieces.h. A cell in which several pieces meet is kept if one of them is.
struct KeptPieces {
    std::uint32_t all = 0,
                  kept = 0; ///< numbers of pieces; 0 if the filter has nothing on the surface
    /// For each cell and triangle of the mesh, 1: kept; both empty if all are.
    std::vector<std::uint8_t> cells, triangles;

    bool keeps(std::size_t cell) const { return cells.empty() || cells[cell] != 0; }
};

/// What a filter says of one surface, as of surface 0.
PieceFilter of_surface(const PieceFilter& filter, std::uint32_t surface);

/// @param mesh of all active cells of a surface @param complete see `pieces_of`
/// @param surface number of the surface in the filter
KeptPieces kept_pieces(const CellMesh& mesh, const Grid& grid, bool complete,
                       const PieceFilter& filter, std::size_t surface);

/// Removes what is not kept.
void keep(CellMesh& mesh, const KeptPieces& kept);

/// The number of triangles of each cell.
std::vector<std::uint8_t> triangles_of_cells(const CellMesh& mesh);
/// The number of cells that have a triangle of each piece. @param triangles of each cell
std::vector<std::uint32_t> cells_of_pieces(std::span<const std::uint8_t> triangles,
                                           const MeshPieces& pieces);

} // namespace isochron::index
