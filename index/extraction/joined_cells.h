// Joins the cells that stay from an earlier set with those that were found anew.
#pragma once

#include "index/search/staying_cells.h"
#include "index/surface/cell_set.h"
#include "index/surface/mesh_maker.h"
#include "index/volume/grid.h"

#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// What became of the cells of one surface from one set to the next.
struct SurfaceChange {
    std::vector<std::uint32_t> removed; ///< places in the ids of the earlier set, ascending
    std::vector<std::uint32_t> added;   ///< places in the ids of the later set, ascending
    bool operator==(const SurfaceChange&) const = default;
};

/// Estimates the share of a set's cells that stay, by one in sixteen of them. 1 if there are none.
/// @param ids ascending
double share_kept(const Grid& grid, std::span<const CellId> ids, const StayingCells& staying);

/// Joins the cells of an earlier set that stay with all others of a step, in the order of ids.
/// @param earlier of the same isovalue; with points if `others` has some
/// @param others the active cells that do not stay
/// @param set gets ids, and points and rows if `others` has points; counts what is kept
/// @param kept if not null, gets EarlierMesh::places @param inner likewise EarlierMesh::inner
SurfaceChange join_cells(const Grid& grid, const CellSet& earlier, const StayingCells& staying,
                         const CellSet& others, CellSet& set,
                         std::vector<std::uint32_t>* kept = nullptr,
                         std::vector<std::uint8_t>* inner = nullptr);

} // namespace isochron::index
