// What of a surface is exported: a part of it, or fewer triangles.
#pragma once

#include "index/surface/cell_mesh.h"
#include "index/volume/grid.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// As options say it.
struct MeshCuts {
    std::optional<std::string> crop; ///< `X0:X1,Y0:Y1,Z0:Z1`, vertices of the grid
    std::vector<double> clip;        ///< a point on a plane and its normal; empty: no plane
    std::optional<double> simplify;  ///< the surface may move so far [unit of the file]
};

/// What is done with each mesh before it is written; null: nothing.
/// @param grid outlives the function, as `moved` does
/// @param unit_factor from the data's unit of length to that of the file
/// @param moved gets the largest error of `simplify`
/// @throws UsageError: an option's value makes no sense
std::function<void(index::CellMesh&)> reshaping(const MeshCuts& cuts, const index::Grid& grid,
                                                double unit_factor, double& moved);

} // namespace isochron::app
