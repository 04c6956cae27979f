// Moves the planes of a coarse level's cells to where the volume's surface is.
#pragma once

#include "index/surface/cell_set.h"

#include <glm/vec3.hpp>

#include <span>

namespace isochron::index {

/// A level has the means of the level before, and a cell's plane lies by the mean of its eight
/// values. Both make a ball smaller and a hollow shallower, by what the surface bends: in voxels,
/// by a sixth of its bend (a twenty-fourth for the level's means, an eighth for the cell's), the
/// sum of its two curvatures. Seen from outside, every outline bends away from the eye, so that
/// without this the picture of a coarse level is too small. The bend is what the normals of a cell
/// and of those beside it in the same chunk differ by.
/// @param points of a level's own grid, ascending; cells without a normal stay as they are
/// @param spacing of the level's grid
void move_planes_out(std::span<CellPoint> points, const glm::dvec3& spacing);

} // namespace isochron::index
