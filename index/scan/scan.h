// Full scan of one step: the reference for the results of every search, and for their speed.
#pragma once

#include "index/volume/query.h"
#include "index/volume/step_values.h"

#include <vector>

namespace isochron::index {

/// Appends the active cells in ascending order. Works row by row on bit masks of `s >= v`. Exact
/// for every type and scaling: the isovalue is first turned into the stored value at which `scaled
/// >= isovalue` changes. The step must be one of the series.
void scan(const StepValues& values, const Query& query, std::vector<CellId>& out);

/// The exact test: keeps, in place and in order, the cells of `ids` that are active. Drops ids that
/// are not cells of the grid, which a damaged index may give.
void keep_active(const StepValues& values, const Query& query, std::vector<CellId>& ids);

} // namespace isochron::index
