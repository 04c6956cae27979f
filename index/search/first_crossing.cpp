// Finds when each cell is first active.
#include "index/search/first_crossing.h"

#include "index/error.h"
#include "index/surface/cell_colors.h"

#include <fmt/format.h>

namespace isochron::index {

FirstCrossingsPtr first_crossings(const SeriesInfo& info, const Search& search, double isovalue,
                                  const std::stop_token& stop) {
    if (info.steps() >= FirstCrossings::kNever)
        throw Error(fmt::format("first crossings of {} steps: expected fewer than {}", info.steps(),
                                FirstCrossings::kNever));
    auto found = std::make_shared<FirstCrossings>();
    found->isovalue = isovalue;
    found->steps.assign(info.grid.cell_count(), FirstCrossings::kNever);
    // Backwards, so that the earliest step is written last and no comparison is needed.
    for (auto step = static_cast<std::uint32_t>(info.steps()); step-- > 0;) {
        const CellSetPtr set = search({step, isovalue}, stop);
        if (!set)
            return nullptr;
        for (const CellId id : set->ids)
            found->steps[id] = static_cast<std::uint16_t>(step);
    }
    return found;
}

void color_by_first_crossing(const FirstCrossings& crossings, const std::vector<double>& times,
                             std::span<const CellId> cells, std::span<std::uint16_t> out) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::uint16_t step = crossings.steps[cells[i]];
        out[i] = step == FirstCrossings::kNever
                     ? kNoColor
                     : color_coordinate(times[step], times.front(), times.back());
    }
}

} // namespace isochron::index
