// Cells and deltas of a whole series in memory, for tests of searches.
#pragma once

#include "index/cells/cell_tier.h"
#include "index/cells/cell_unit_build.h"
#include "index/scan/scan.h"

#include "tests/support/test_field.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace isochron::index {

/// Builds every unit one after another. Owns the bytes; those of the series stay with the caller.
class CellSeries {
  public:
    CellSeries(const StepValues& series, LevelMap levels) : values(series), map(std::move(levels)) {
        const Stretches stretches(values.grid);
        const auto steps = static_cast<std::uint32_t>(values.steps);
        StretchRanks ranks(values, map);
        CellUnitBuilder builder;
        for (std::uint32_t first = 0; first < steps; first += TimePath::kMaxSteps)
            for (std::uint32_t stretch = 0; stretch < stretches.count(); ++stretch) {
                const std::uint32_t before = first > 0 ? 1 : 0;
                ranks.compute(stretch, first - before,
                              std::min(TimePath::kMaxSteps, steps - first) + before);
                builder.build_cells(ranks, before, map.lossless(), cells.emplace_back());
                if (map.lossless())
                    builder.build_deltas(ranks, before, deltas.emplace_back());
            }
    }

    CellTier tier() const {
        return CellTier(Stretches(values.grid), static_cast<std::uint32_t>(values.steps),
                        spans(cells), spans(deltas));
    }
    std::optional<LevelMap::Cut> cut(double isovalue) const {
        return map.cut(values.scaling, isovalue);
    }
    std::size_t cell_bytes() const { return total(cells); }
    std::size_t delta_bytes() const { return total(deltas); }

    StepValues values;
    LevelMap map;
    std::vector<std::vector<std::byte>> cells, deltas;

  private:
    static CellTier::Units spans(const std::vector<std::vector<std::byte>>& units) {
        return {units.begin(), units.end()};
    }
    static std::size_t total(const std::vector<std::vector<std::byte>>& units) {
        std::size_t sum = 0;
        for (const auto& unit : units)
            sum += unit.size();
        return sum;
    }
};

/// A random number below `end`.
inline std::uint32_t below(std::mt19937& random, std::uint32_t end) {
    return static_cast<std::uint32_t>(random()) % end;
}

/// The cells of the runs in ascending order.
inline std::vector<CellId> sorted_ids(const std::vector<IdRun>& runs) {
    std::vector<CellId> ids;
    assign_ids(runs, ids);
    std::sort(ids.begin(), ids.end());
    return ids;
}

/// The active cells in ascending order, the ambiguous ones tested in the volume.
inline std::vector<CellId> search(const CellTier& tier, const CellSeries& series,
                                  std::uint32_t step, double isovalue) {
    const auto cut = series.cut(isovalue);
    if (!cut)
        return {};
    std::vector<IdRun> certain, ambiguous;
    tier.search(step, *cut, certain, ambiguous);
    std::vector<CellId> ids = sorted_ids(certain), open = sorted_ids(ambiguous);
    keep_active(series.values, {Instant(step), isovalue}, open);
    ids.insert(ids.end(), open.begin(), open.end());
    std::sort(ids.begin(), ids.end());
    return ids;
}

} // namespace isochron::index
