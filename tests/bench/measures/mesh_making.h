// The time that a mesh takes, made from the cells that were found, beside flying edges.
#pragma once

#include "index/volume/grid.h"
#include "index/volume/query.h"
#include "index/volume/step_values.h"

#include <cstddef>
#include <span>

namespace isochron::bench {

/// One thread each, all values in memory, both with normals.
struct MeshMaking {
    double seconds = 0;        ///< from the active cells to the mesh
    double seconds_of_vtk = 0; ///< flying edges, from the values
    std::size_t triangles = 0;
};

/// @param ids the active cells of `query`, ascending
/// @throws index::Error when the module with VTK cannot be loaded, or finds another number of
/// triangles
MeshMaking measure_mesh_making(const index::StepValues& values, const index::Query& query,
                               std::span<const index::CellId> ids);

} // namespace isochron::bench
