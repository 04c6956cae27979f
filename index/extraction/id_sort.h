// Ascending order for sets of cell ids.
#pragma once

#include "index/volume/grid.h"

#include <vector>

namespace isochron::index {

/// Sorts ids, by marking bits where that is cheaper than comparing. Drops what a damaged index may
/// give: repeated ids and ids that are not below `cells`.
void sort_ids(std::vector<CellId>& ids, std::uint64_t cells);

} // namespace isochron::index
