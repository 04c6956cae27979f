// Finds when each cell is first active at an isovalue, by searching all steps.
#pragma once

#include "index/search/index_search.h"
#include "index/surface/cell_set.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// The first step at which each cell is active, by cell id, or kNever. Two bytes for each cell. Where
/// steps are blended, the first instant: two bytes more.
struct FirstCrossings {
    static constexpr std::uint16_t kNever = 0xffff;
    double isovalue = 0;
    std::vector<std::uint16_t> steps;
    std::vector<std::uint16_t> fractions =
        {}; ///< shares of the way to the next step; empty: steps alone
    bool blended() const { return !fractions.empty(); }
};
using FirstCrossingsPtr = std::shared_ptr<const FirstCrossings>;

/// Sets the first instant of cells that are first active between a step and the next one, if ever,
/// among all that are active there. @return false when stopped
using CrossingsBetween = std::function<bool(std::uint32_t step, FirstCrossings& found)>;

/// Finds crossings of blends at a level of detail: the first instant at which a vertex of the cell
/// comes to be on the other side of the isovalue than others, exactly. Reads the chunks alone
/// between whose values at both steps the isovalue lies. @throws Error as ChunkStore does
CrossingsBetween crossings_between(std::shared_ptr<const IndexFile> file, std::size_t level,
                                   double isovalue, std::stop_token stop);

/// Searches every step, which takes as long as a query for each step: do not call it on the render
/// thread.
/// @param between empty: of steps alone @return null when stopped
/// @throws Error as the search does, and for a series of 65,535 steps or more
FirstCrossingsPtr first_crossings(const SeriesInfo& info, const Search& search, double isovalue,
                                  const std::stop_token& stop = {},
                                  const CrossingsBetween& between = {});

/// Color coordinates (`color_coordinate`) of the physical times of the cells' first crossings, in
/// the range of the times of the whole series.
/// @param at the moment at which the cells are active. Between two steps, cells that no step up to
///        then has get the time of the moment, which is at most a step late, unless the crossings
///        are those of blends
void color_by_first_crossing(const FirstCrossings& crossings, const std::vector<double>& times,
                             Instant at, std::span<const CellId> cells,
                             std::span<std::uint16_t> out);

} // namespace isochron::index
