// What is asked of an index: one isovalue at one step.
#pragma once

#include <cstdint>

namespace isochron::index {

/// Active cells are those with min < isovalue <= max over their 8 scaled vertex values, none of
/// them NaN. An isovalue that is NaN or infinite has no active cells.
struct Query {
    std::uint32_t step = 0;
    double isovalue = 0.0;
    bool operator==(const Query&) const = default;
};

} // namespace isochron::index
