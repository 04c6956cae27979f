// Sorts sets of cell ids.
#pragma once

#include "index/volume/grid.h"

#include <vector>

namespace isochron::index {

/// Sorts ids, by marking bits if that is cheaper than comparing. Drops repeated ids and ids that
/// are not below `cells`, which a damaged index may give.
void sort_ids(std::vector<CellId>& ids, std::uint64_t cells);

} // namespace isochron::index
