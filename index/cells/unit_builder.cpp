// Builds the units of a series: cells and deltas of one stretch in one epoch.
#include "index/cells/unit_builder.h"

#include "index/cells/cell_unit.h"

#include <algorithm>
#include <numeric>

namespace isochron::index {

UnitBuilder::UnitBuilder(const StepValues& values, const LevelMap& levels)
    : steps_(static_cast<std::uint32_t>(values.steps)), lossless_(levels.lossless()),
      ranks_(values, levels) {}

void UnitBuilder::build(std::uint32_t stretch, std::uint32_t epoch, bool deltas, UnitBytes& out) {
    const std::uint32_t first = epoch * TimePath::kMaxSteps;
    const std::uint32_t count = std::min(TimePath::kMaxSteps, steps_ - first);
    const std::uint32_t before = deltas && epoch > 0 ? 1 : 0; // the step before the epoch
    ranks_.compute(stretch, first - before, count + before);
    builder_.build_cells(ranks_, before, lossless_, out.cells);
    const auto entries = CellUnit(out.cells, 0).entries();
    out.entries = std::accumulate(entries.begin(), entries.end(), std::uint64_t{0});
    if (deltas)
        builder_.build_deltas(ranks_, before, out.deltas);
}

} // namespace isochron::index
