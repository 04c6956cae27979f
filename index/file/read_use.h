// Statistics of reading an index.
#pragma once

#include <cstdint>

namespace isochron::index {

/// What was read since the index was opened.
struct ReadUse {
    std::uint64_t bytes = 0;            ///< read from the file
    std::uint64_t hits = 0, misses = 0; ///< requests that the cache had, or that had to be read
    std::uint64_t held = 0, budget = 0; ///< bytes in memory, and the most there may be
};

} // namespace isochron::index
