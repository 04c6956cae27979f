// A surface in one cell, with all that any footprint needs: to be drawn before there are data.
#pragma once

#include "index/extraction/extraction.h"
#include "index/volume/grid.h"

namespace isochron::app {

/// A grid of 4^3 vertices. @param rectilinear whether it has positions of its own
index::Grid small_grid(bool rectilinear);

/// A plane through the cell in the middle of this grid, across its third axis: with its point, a
/// mesh and the volume around it.
index::ExtractionPtr small_surface(const index::Grid& grid);

} // namespace isochron::app
