// Where the vertices and cells of a grid lie along its axes, in single precision as shaders see it.
#pragma once

#include "index/volume/grid.h"

#include <array>
#include <vector>

namespace isochron::render {

/// Places and sizes in even coordinates (`index::Grid::physical_from_index`).
struct AxisPlaces {
    std::vector<float> place; ///< place of each vertex
    /// Side of the cell behind each vertex; for the last vertex, which has none, of the last cell.
    std::vector<float> side;
};

std::array<AxisPlaces, 3> axis_places(const index::Grid& grid);

} // namespace isochron::render
