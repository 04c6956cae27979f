// Counts the false positives and false negatives of a structure.
#include "tests/bench/measures/errors.h"

#include "index/scan/scan.h"

#include <vector>

namespace isochron::bench {

ErrorCount count_errors(const index::StepValues& values, const Structure& structure,
                        std::span<const double> isovalues,
                        const std::function<void(double)>& progress) {
    enum class Cell : std::uint8_t { inactive, active, found };
    std::vector<Cell> state(values.grid.cell_count(), Cell::inactive);
    ErrorCount count;
    Ids active, found;
    for (std::uint32_t step = 0; step < values.steps; ++step) {
        progress(static_cast<double>(step) / static_cast<double>(values.steps));
        for (const double isovalue : isovalues) {
            const index::Query query{step, isovalue};
            active.clear();
            found.clear();
            index::scan(values, query, active);
            structure.ids(query, found);
            for (const index::CellId id : active)
                state[id] = Cell::active;
            std::uint64_t hits = 0;
            for (const index::CellId id : found)
                if (id < state.size() && state[id] == Cell::active) {
                    state[id] = Cell::found;
                    ++hits;
                }
            count.active += active.size();
            count.false_positives += found.size() - hits;
            count.false_negatives += active.size() - hits;
            for (const index::CellId id : active)
                state[id] = Cell::inactive;
        }
    }
    return count;
}

} // namespace isochron::bench
