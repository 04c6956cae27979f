// The result of one query: immutable once frozen, shared between the worker and the renderer.
#pragma once

#include "index/extraction/cell_mesh.h"
#include "index/extraction/cell_plane.h"
#include "index/volume/query.h"
#include "index/volume/step_values.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// One cell as the GPU takes it: 12 bytes, no padding.
struct CellPoint {
    std::uint16_t x, y, z; ///< cell coordinates; the center is at +0.5 in vertex index coordinates
    /// Bits 0 to 2: which surface, 0 to kMostSurfaces - 1; bits 3 to 15: where its color lies in a
    /// color map, 0 to 8191. Both 0 in a set of one query.
    std::uint16_t style;
    /// The plane of the surface in the cell: see `pack` in cell_plane.h. All zero where the
    /// gradient vanishes or is not finite.
    std::uint32_t plane;
};
static_assert(sizeof(CellPoint) == 12);

/// A stretch of cells with the same y and z: lets a renderer order cells in linear time.
struct CellRow {
    std::uint16_t y, z;
    std::uint32_t begin; ///< into ids and points; ends where the next row begins
};

struct CellSet {
    Query query;
    SearchMethod method = SearchMethod::scan;
    std::vector<CellId> ids;                  ///< ascending, where all of the grid's fit
    std::vector<CellPoint> points;            ///< same order
    std::vector<CellRow> rows;                ///< ascending (z, y), non-empty rows only
    std::uint64_t candidates = 0;             ///< cells the search returned before the exact test
    std::uint64_t reused = 0;                 ///< of these, taken over from the previous search
    std::chrono::nanoseconds search_time{0};  ///< search and exact test
    CellMeshPtr mesh;                         ///< null where none was asked for
    std::chrono::nanoseconds shading_time{0}; ///< positions and normals, and the mesh
};

using CellSetPtr = std::shared_ptr<const CellSet>;

/// Fills `points` and `rows` from `ids`. The normal is the negated mean of the eight vertices'
/// central-difference gradients (one-sided at the border) in physical space.
/// The plane's offset is that of the set's isovalue.
/// @return false when it was stopped and the set is incomplete
bool shade_cells(const StepValues& values, CellSet& set, const std::stop_token& stop = {});

/// The normal of one cell as above, unpacked, for tests and reports; zero where it has none.
glm::dvec3 cell_normal(const StepValues& values, std::uint32_t step, CellId cell);

/// The plane of one cell likewise; no offset where the cell's own slope does not rise along the
/// normal.
CellPlane cell_plane(const StepValues& values, const Query& query, CellId cell);

} // namespace isochron::index
