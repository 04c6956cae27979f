// Counts the false positives and false negatives of a structure.
#include "tests/bench/measures/errors.h"

#include "index/scan/scan.h"

#include <algorithm>
#include <vector>

namespace isochron::bench {

ErrorCount count_errors(const index::StepValues& values, const Structure& structure,
                        std::span<const double> isovalues,
                        const std::function<void(double)>& progress) {
    std::vector<bool> missing(values.grid.cell_count()); // active and not found yet
    ErrorCount count;
    Ids active, found;
    for (std::uint32_t step = 0; step < values.steps; ++step) {
        progress(static_cast<double>(step) / static_cast<double>(values.steps));
        for (const double isovalue : isovalues) {
            const index::Query query{index::Instant(step), isovalue};
            active.clear();
            index::scan(values, query, active);
            structure.ids(query, found);
            for (const index::CellId id : active)
                missing[id] = true;
            std::uint64_t hits = 0;
            for (const index::CellId id : found)
                if (id < missing.size() && missing[id]) {
                    missing[id] = false;
                    ++hits;
                }
            count.active += active.size();
            count.false_positives += found.size() - hits;
            count.false_negatives += active.size() - hits;
            if (hits < active.size())
                std::fill(missing.begin(), missing.end(), false);
        }
    }
    return count;
}

} // namespace isochron::bench
