// Counts the false positives and false negatives of a structure.
#pragma once

#include "index/volume/step_values.h"
#include "tests/bench/measures/structure.h"

#include <cstdint>
#include <functional>
#include <span>

namespace isochron::bench {

struct ErrorCount {
    std::uint64_t active = 0;          ///< truly active cells over all queries
    std::uint64_t false_positives = 0; ///< found but not active, or found twice
    std::uint64_t false_negatives = 0;
};

/// Compares the answers at every step and isovalue with those of the scan.
/// @param progress fraction done
ErrorCount count_errors(const index::StepValues& values, const Structure& structure,
                        std::span<const double> isovalues,
                        const std::function<void(double)>& progress);

} // namespace isochron::bench
