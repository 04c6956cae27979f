// Sorts sets of cell ids.
#pragma once

#include "index/volume/grid.h"

#include <vector>

namespace isochron::index {

/// Sorts ids, by marking bits if that is cheaper than comparing. Drops repeated ids and ids that
/// are not below `cells`, which a damaged index may give.
void sort_ids(std::vector<CellId>& ids, std::uint64_t cells);

/// Sorts ids that come in groups, as those of bricks do: all those below a multiple of `group` before
/// all others. The marks of one group are used for all.
void sort_ids(std::vector<CellId>& ids, std::uint64_t cells, std::uint64_t group);

} // namespace isochron::index
