// Surfaces with fewer triangles, for files: how far they have moved is measured.
#pragma once

#include "index/surface/cell_mesh.h"
#include "index/volume/grid.h"

#include <functional>

namespace isochron::index {

/// Removes triangles while no point of the surface lies farther from what is left, and none of what is
/// left farther from the surface, than `most`: both distances are measured afterwards (mesh_distance.h),
/// and it is done again more finely until they hold. Vertices that stay keep their places. What is closed
/// stays closed, an edge of two triangles keeps two, also where vertices lie in one place, and each part
/// keeps four triangles at least, or one if it has a border.
/// @param most distance [the data's unit of length], above 0
/// @param look called now and then; it may throw
/// @return a distance that neither of both exceeds, at most `most`, and 5 % or a hundredth of `most` above
///         the largest one at most
double simplify(CellMesh& mesh, const Grid& grid, double most,
                const std::function<void()>& look = {});

/// The shortest side of any cell [the data's unit of length].
double shortest_side(const Grid& grid);

} // namespace isochron::index
