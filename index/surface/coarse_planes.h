// Moves the planes of a coarse level's cells to where the volume's surface is.
#pragma once

#include "index/surface/cell_set.h"

#include <glm/vec3.hpp>

#include <span>

namespace isochron::index {

/// Moves planes outwards where the surface bends. A level holds means of the level before, and a
/// cell's plane lies by the mean of its eight values: both make a ball smaller and a hollow
/// shallower. In voxels, a plane is off by a sixth of the bend, which is the sum of the surface's
/// two curvatures (a twenty-fourth for the level's means, an eighth for the cell's mean). Seen from
/// outside, every outline bends away from the eye, so that without this the picture of a coarse
/// level is too small. The bend is measured by the difference between a cell's normal and the
/// normals of the cells beside it in the same chunk.
/// @param points of a level's own grid, ascending; cells without a normal stay as they are
/// @param spacing of the level's grid
void move_planes_out(std::span<CellPoint> points, const glm::dvec3& spacing);

} // namespace isochron::index
