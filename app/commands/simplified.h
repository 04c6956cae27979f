// Surfaces with fewer triangles, for files.
#pragma once

#include "index/surface/cell_mesh.h"
#include "index/volume/grid.h"

namespace isochron::app {

/// Whether this build has the library that simplifies.
bool can_simplify();

/// Removes triangles while the surface moves by no more than about `error`, measured by quadrics of
/// the triangles around each vertex (meshoptimizer). That is no bound: parts may move several times
/// as far. Vertices that stay keep their places, and borders are kept as well as the rest. Nothing
/// remains of a surface that is small compared with `error`.
/// @param error distance [the data's unit of length], above 0
/// @return about how far it has moved
double simplify(index::CellMesh& mesh, const index::Grid& grid, double error);

} // namespace isochron::app
