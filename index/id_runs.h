// Search results as runs: references to the ids where they lie in the index.
#pragma once

#include "index/grid.h"

#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// The cells `first + ids[0]` to `first + ids[count - 1]` of one chunk. Up to kSlack ids behind the
/// run may be read too (and are of no meaning), so that it can be copied in whole vectors.
struct IdRun {
    static constexpr std::size_t kSlack = 32;
    const std::uint16_t* ids;
    std::uint32_t count;
    CellId first;
};

/// Appends the cells of the runs, in their order.
void append_ids(std::span<const IdRun> runs, std::vector<CellId>& out);

} // namespace isochron::index
