// Finds when each cell is first active at an isovalue, by searching all steps.
#pragma once

#include "index/search/index_search.h"
#include "index/surface/cell_set.h"

#include <cstdint>
#include <memory>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// The first step at which each cell is active, by cell id, or kNever. Two bytes for each cell.
struct FirstCrossings {
    static constexpr std::uint16_t kNever = 0xffff;
    double isovalue = 0;
    std::vector<std::uint16_t> steps;
};
using FirstCrossingsPtr = std::shared_ptr<const FirstCrossings>;

/// Searches every step, which takes as long as a query for each step: do not call it on the render
/// thread.
/// @return null when stopped
/// @throws Error as the search does, and for a series of 65,535 steps or more
FirstCrossingsPtr first_crossings(const SeriesInfo& info, const Search& search, double isovalue,
                                  const std::stop_token& stop = {});

/// Color coordinates (`color_coordinate`) of the physical times of the cells' first crossings, in
/// the range of the times of the whole series.
void color_by_first_crossing(const FirstCrossings& crossings, const std::vector<double>& times,
                             std::span<const CellId> cells, std::span<std::uint16_t> out);

} // namespace isochron::index
