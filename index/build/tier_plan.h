// The choice of tiers for a series.
#pragma once

#include "index/file/tiers.h"
#include "index/volume/level_map.h"
#include "index/volume/step_values.h"
#include "index/volume/volume_series.h"

#include <optional>

namespace isochron::index {

/// Whether what was asked for can be, as far as that shows before the values are read.
/// @throws Error when it cannot
void check_tiers(const Grid& grid, const TierSet& asked);

/// Whether steps are so small that cells may pay: of larger ones bricks read less, however slowly
/// they change.
bool cells_may_pay(const SeriesInfo& info);

/// Bricks always; cells where levels are lossless, so that an entry never needs the volume, and
/// where the series is small or they pay for their bytes; deltas where a step changes fewer cells
/// than a search finds, and likewise. What was asked for overrides that.
/// Looks at a sample of the steps and chunks, which depends on the series alone; at none of the
/// values where cells cannot pay or levels are not lossless.
/// @throws Error when something was asked for that cannot be
TierPlan plan_tiers(const StepValues& values, const LevelMap& levels,
                    const std::optional<TierSet>& asked);

/// Mean over all isovalues of (added + removed cells) / (active cells), from step to step.
/// Infinite where no cell is ever active; 0 for one step.
double churn(const StepValues& values, const LevelMap& levels);

/// What cells take, of a sample.
struct CellCost {
    double entries = 0; ///< for each cell and step: 1 where nothing merges in time
    double cell_bytes = 0, delta_bytes = 0; ///< for each byte of values
};
/// Cells that are active at no isovalue have no entries.
CellCost cost_of_cells(const StepValues& values, const LevelMap& levels);

} // namespace isochron::index
