// Levels of detail: each step again with about half the vertices along each axis, and so on down.
//
// Level 0 is the step itself. Of the vertices of a level the next has those with even coordinates,
// and the last along each axis: the vertices of level k lie at every 2^k-th position of level 0,
// and on its border. A value is the mean of the level below with weights 1 2 1 along each axis,
// that is, of a vertex and its up to 26 neighbors with weights 8, 4, 2 and 1. Neighbors outside the
// grid, and those that are NaN, are left out of it; where none is left it is NaN. Integers are
// rounded to the nearest, halves upwards. Sums of floats are made in double, (a + 2 b) + c along x,
// then of these along y, then along z, and so are those of their weights; their quotient is
// rounded to the type.
#pragma once

#include "index/volume/grid.h"
#include "index/volume/value_type.h"

#include <cstddef>
#include <span>
#include <vector>

namespace isochron::index {

/// The grids of all levels, the finest first: down to one that a single chunk of the file holds.
/// The spacing of level k is 2^k times that of level 0, but between the last two vertices along an
/// axis, which may be nearer to each other.
std::vector<Grid> detail_grids(const Grid& grid);

/// Values of the next level. With all threads. @param stored values of a level on `grid`,
/// [z][y][x], x fastest @param out as many as the next grid has vertices
void coarsen(ValueType type, const Grid& grid, std::span<const std::byte> stored,
             std::span<std::byte> out, unsigned threads);

} // namespace isochron::index
