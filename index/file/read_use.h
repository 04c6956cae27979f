// What reading an index has come to.
#pragma once

#include <cstdint>

namespace isochron::index {

/// Since the index was opened.
struct ReadUse {
    std::uint64_t bytes = 0;            ///< read from the file
    std::uint64_t hits = 0, misses = 0; ///< of what was asked for: was at hand, or had to be read
    std::uint64_t held = 0, budget = 0; ///< bytes in memory, and how many there may be
};

} // namespace isochron::index
