// The result of one query: constant once it is complete, shared by the worker and the renderer.
#pragma once

#include "index/surface/cell_mesh.h"
#include "index/surface/cell_plane.h"
#include "index/volume/query.h"
#include "index/volume/step_values.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// One cell in the GPU's format: 12 bytes, no padding.
struct CellPoint {
    std::uint16_t x, y, z; ///< cell coordinates; the center is at +0.5 in vertex index coordinates
    /// Bits 0 to 2: number of the surface, 0 to kMostSurfaces - 1; bits 3 to 15: its color
    /// coordinate, 0 to 8191 (cell_colors.h). Both 0 in a set of one query.
    std::uint16_t style;
    /// The plane of the surface in the cell: see `pack` in cell_plane.h. All zero if the gradient
    /// is zero or not finite.
    std::uint32_t plane;
};
static_assert(sizeof(CellPoint) == 12);

/// A row: the cells with the same y and z. Rows let a renderer order cells in linear time.
struct CellRow {
    std::uint16_t y, z;
    std::uint32_t begin; ///< into ids and points; ends where the next row begins
};

struct CellSet {
    Query query;
    SearchMethod method = SearchMethod::scan;
    std::vector<CellId> ids;                  ///< ascending, unless the grid has wide ids
    std::vector<CellPoint> points;            ///< in the same order
    std::vector<CellRow> rows;                ///< ascending (z, y), non-empty rows only
    std::uint64_t candidates = 0;             ///< cells that the search found before the exact test
    std::uint64_t reused = 0;                 ///< of these, taken from the previous search
    std::chrono::nanoseconds search_time{0};  ///< of search and exact test
    CellMeshPtr mesh;                         ///< null if none was asked for
    std::chrono::nanoseconds shading_time{0}; ///< of positions, normals and the mesh
};

using CellSetPtr = std::shared_ptr<const CellSet>;

/// Fills `points` and `rows` from `ids`. The normal is the negated mean of the eight vertices'
/// central-difference gradients (one-sided at the border) in physical space. The plane's offset is
/// for the set's isovalue.
/// @return false when it was stopped and the set is incomplete
bool shade_cells(const StepValues& values, CellSet& set, const std::stop_token& stop = {});

/// The normal of one cell as above, unpacked, for tests and reports; zero if it has none.
glm::dvec3 cell_normal(const StepValues& values, std::uint32_t step, CellId cell);
/// The plane of one cell in the same way; offset 0 if the cell's own slope does not rise against
/// the normal.
CellPlane cell_plane(const StepValues& values, const Query& query, CellId cell);

} // namespace isochron::index
