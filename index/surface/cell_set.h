// The result of one query: constant once it is complete, shared by the worker and the renderer.
#pragma once

#include "index/surface/cell_mesh.h"
#include "index/surface/cell_plane.h"
#include "index/surface/gpu_formats.h"
#include "index/volume/query.h"
#include "index/volume/step_values.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// What a search finds.
struct FoundCells {
    Query query;
    SearchMethod method = SearchMethod::scan;
    std::vector<CellId> ids;      ///< ascending, unless the grid has wide ids
    std::uint64_t candidates = 0; ///< cells that the search found before the exact test
    /// Number of active cells that were taken over from an earlier result and not looked for again.
    std::uint64_t reused = 0;
    std::chrono::nanoseconds search_time{0}; ///< time of search and exact test
};

/// Found cells, and beside them what a renderer draws, in its formats.
struct CellSet : FoundCells {
    std::vector<CellPoint> points;            ///< in the order of the ids
    std::vector<CellRow> rows;                ///< ascending (z, y), non-empty rows only
    CellMeshPtr mesh;                         ///< null if none was asked for
    std::chrono::nanoseconds shading_time{0}; ///< time for positions, normals and the mesh
};

using CellSetPtr = std::shared_ptr<const CellSet>;

/// Makes points and rows of cells. The normal is the negated mean of the eight vertices'
/// central-difference gradients (one-sided at the border) in physical space. The plane's offset is
/// for the isovalue.
/// @param ids ascending
/// @return false when it was stopped and the points are incomplete
bool shade_cells(const StepValues& values, const Query& query, std::span<const CellId> ids,
                 std::vector<CellPoint>& points, std::vector<CellRow>& rows,
                 const std::stop_token& stop = {});
inline bool shade_cells(const StepValues& values, CellSet& set, const std::stop_token& stop = {}) {
    return shade_cells(values, set.query, set.ids, set.points, set.rows, stop);
}

/// The normal of one cell as above, unpacked, for tests and reports; zero if it has none.
glm::dvec3 cell_normal(const StepValues& values, std::uint32_t step, CellId cell);
/// The plane of one cell in the same way; offset 0 if the cell's own slope does not rise against
/// the normal.
CellPlane cell_plane(const StepValues& values, const Query& query, CellId cell);

} // namespace isochron::index
