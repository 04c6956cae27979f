// The part of a cell that the triangles of a surface cut off.
#pragma once

#include "index/measure/plane_cut.h"
#include "index/surface/cell_mesh.h"

#include <cstdint>
#include <span>

namespace isochron::index {

/// The share of an active cell's volume, 0 to 1, on the side of its vertices that are above: it is
/// bounded by the cell's triangles, and on each face of the cell by their sides there, so that
/// neighboring cells agree. Volumes of all cells, and of all cells on that side as a whole, add up
/// to what the surface encloses.
/// @param vertices of the mesh @param corners of the cell's triangles, three each
/// @param of_cell the cell's case
double share_above(std::span<const MeshVertex> vertices, std::span<const std::uint32_t> corners,
                   std::uint8_t of_cell);
/// The share that is also on the side of a plane that is left. @param corners may be empty for a
/// cell all of whose vertices are above @param plane that cuts the cell
double share_above(std::span<const MeshVertex> vertices, std::span<const std::uint32_t> corners,
                   std::uint8_t of_cell, const CellCut& plane);

} // namespace isochron::index
