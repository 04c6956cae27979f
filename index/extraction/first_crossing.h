// When each cell first became active: a sweep over all steps for one isovalue.
#pragma once

#include "index/extraction/cell_set.h"
#include "index/extraction/index_search.h"

#include <cstdint>
#include <memory>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// By cell id, the first step at which the cell is active, or kNever. Two bytes for each cell.
struct FirstCrossings {
    static constexpr std::uint16_t kNever = 0xffff;
    double isovalue = 0;
    std::vector<std::uint16_t> steps;
};
using FirstCrossingsPtr = std::shared_ptr<const FirstCrossings>;

/// Searches every step: in series of many steps as long as many queries take, so not for the
/// thread that draws.
/// @return null when stopped
/// @throws Error as the search does, and for a series of 65,535 steps or more
FirstCrossingsPtr first_crossings(const SeriesInfo& info, const Search& search, double isovalue,
                                  const std::stop_token& stop = {});

/// Color coordinates (`color_coordinate`) of the physical times of the cells' first crossings,
/// over the times of the whole series.
void color_by_first_crossing(const FirstCrossings& crossings, const std::vector<double>& times,
                             std::span<const CellId> cells, std::span<std::uint16_t> out);

} // namespace isochron::index
