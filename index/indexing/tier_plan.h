// Chooses the tiers for a series.
#pragma once

#include "index/file/sections/tiers.h"
#include "index/volume/level_map.h"
#include "index/volume/step_values.h"
#include "index/volume/volume_series.h"

#include <optional>

namespace isochron::index {

/// Checks whether the tiers can be built, as far as the grid shows it.
/// @throws Error when they cannot
void check_tiers(const Grid& grid, const TierSet& asked);

/// Whether steps are small enough for cells to be worth their bytes. In larger steps bricks read
/// less, however slowly the data change.
bool cells_may_pay(const SeriesInfo& info);

/// Chooses bricks always. Chooses cells if levels are lossless, so that an entry never needs the
/// volume, and if the index with them takes at most 1.2 times the bytes of the values. Of series of up
/// to 128 KiB it chooses cells whatever they take, and deltas if a step changes fewer cells than a
/// search finds; else no deltas: on the way to a picture nothing uses them. `asked` overrides the
/// choice. Looks at a sample of the steps and chunks, which depends on the series only; reads no values
/// if cells cannot pay or levels are not lossless.
/// @param others bytes of all else in the index for each byte of values
/// @throws Error when `asked` has a tier that cannot be built
TierPlan plan_tiers(const StepValues& values, const LevelMap& levels,
                    const std::optional<TierSet>& asked, double others = 0);

/// Mean over all isovalues of (added + removed cells) / (active cells), from step to step.
/// Infinite if no cell is ever active; 0 for one step.
double churn(const StepValues& values, const LevelMap& levels);

/// The size of cells, estimated from a sample.
struct CellCost {
    double entries = 0;                     ///< for each cell and step: 1 if nothing merges in time
    double cell_bytes = 0, delta_bytes = 0; ///< for each byte of values
};
/// Cells that are active at no isovalue have no entries.
CellCost cost_of_cells(const StepValues& values, const LevelMap& levels);

} // namespace isochron::index
