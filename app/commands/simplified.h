// Surfaces with fewer triangles, for files.
#pragma once

#include "index/surface/cell_mesh.h"
#include "index/volume/grid.h"

namespace isochron::app {

/// Whether this build has the library that simplifies.
bool can_simplify();

/// Removes triangles as long as the surface moves by no more than `error`, by quadrics of the
/// triangles around each vertex (meshoptimizer). Vertices that stay keep their places, borders are
/// kept as well as the rest.
/// @param error largest distance [the data's unit of length], above 0
/// @return the distance by which it has moved, as far as the library knows
double simplify(index::CellMesh& mesh, const index::Grid& grid, double error);

} // namespace isochron::app
