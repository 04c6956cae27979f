// Full scan of one step: the oracle that every search structure is compared with, and a fair rival.
#pragma once

#include "index/volume/query.h"
#include "index/volume/step_values.h"

#include <vector>

namespace isochron::index {

/// Appends the active cells in ascending order. Works row by row on bit masks of `s >= v`.
/// Exact for every type and scaling: the isovalue is first turned into the stored value where the
/// answer of `scaled >= isovalue` changes. The step must be one of the series.
void scan(const StepValues& values, const Query& query, std::vector<CellId>& out);

/// Keeps, in place and in order, the cells of `ids` that are truly active: the exact mode's test.
/// Ids that are no cell of the grid, as a damaged index may give, are dropped.
void keep_active(const StepValues& values, const Query& query, std::vector<CellId>& ids);

} // namespace isochron::index
