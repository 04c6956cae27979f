// The options of the paper's Temporal Hierarchical Index Tree.
#pragma once

#include <cstdint>

namespace isochron::index {

struct ThiOptions {
    std::uint32_t lattice = 64; ///< SpanSpaceSize L: the lattice has L x L elements; 1 to 4096
    std::uint32_t max_variation =
        2; ///< most distinct lattice elements of a cell that counts as constant; 1 to 64
    bool operator==(const ThiOptions&) const = default;
};

} // namespace isochron::index
