// What of a surface is exported: a part of it, or fewer triangles.
#pragma once

#include "index/export/surface_export.h"
#include "index/surface/mesh_crop.h"
#include "index/volume/grid.h"
#include "interaction/setting_values.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// The options that cut or simplify exported surfaces.
struct MeshCuts {
    std::uint32_t dust = 0;          ///< pieces of fewer active cells are left out, before all else
    std::optional<std::string> crop; ///< `X0:X1,Y0:Y1,Z0:Z1`, vertices of the grid
    std::vector<double> clip;        ///< a point on a plane and its normal; empty: no plane
    /// How far the surface may move: in the unit of the file, or `0.5cells`.
    std::optional<std::string> simplify;
};

/// The largest results of `simplify`.
struct SimplifiedBy {
    double moved = 0; ///< [unit of the file]
    double cells = 0; ///< [shortest side of a cell]
};

/// The vertices that `--crop X0:X1,Y0:Y1,Z0:Z1` names. @throws UsageError
index::VertexBox box_of(const std::string& text, const index::Grid& grid);

/// The plane that `--clip` names: a point on it and its normal. @param numbers empty: none
/// @throws UsageError
std::optional<interaction::ClipPlane> plane_of(const std::vector<double>& numbers);

/// What is done with each mesh before it is written; null: nothing.
/// @param complete see index::pieces_of
/// @param grid outlives the function, as `plan` and `moved` do
/// @param plan says the file's unit and precision
/// @param moved gets how far surfaces have moved, with what the file rounds
/// @return throws Error where `simplify` leaves nearly nothing of a surface, or asks for less than the
///         file rounds
/// @throws UsageError: an option's value makes no sense
decltype(index::ExportRequest::reshape) reshaping(const MeshCuts& cuts, const index::Grid& grid,
                                                  bool complete, const index::ExportPlan& plan,
                                                  SimplifiedBy& moved);

} // namespace isochron::app
