// What of a surface is exported: a part of it, or fewer triangles.
#pragma once

#include "index/export/surface_writer.h"
#include "index/surface/cell_mesh.h"
#include "index/volume/grid.h"
#include "index/volume/query.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// The options that cut or simplify exported surfaces.
struct MeshCuts {
    std::optional<std::string> crop; ///< `X0:X1,Y0:Y1,Z0:Z1`, vertices of the grid
    std::vector<double> clip;        ///< a point on a plane and its normal; empty: no plane
    std::optional<double> simplify;  ///< the surface may move about so far [unit of the file]
};

/// What is done with each mesh before it is written; null: nothing.
/// @param grid outlives the function, as `moved` does
/// @param plan says the file's unit of length
/// @param moved gets the largest result of `simplify`
/// @return throws Error where `simplify` leaves nothing of a surface
/// @throws UsageError: an option's value makes no sense
std::function<void(index::CellMesh&, const index::Query&)> reshaping(const MeshCuts& cuts,
                                                                     const index::Grid& grid,
                                                                     const index::ExportPlan& plan,
                                                                     double& moved);

} // namespace isochron::app
