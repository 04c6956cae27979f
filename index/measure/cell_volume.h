// The part of a cell that the triangles of a surface cut off.
#pragma once

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

} // namespace isochron::index
