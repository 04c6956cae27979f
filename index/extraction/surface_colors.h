// Computes the color coordinates of an extraction's cells.
#pragma once

#include "index/search/first_crossing.h"
#include "index/search/layer_search.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// Colors the cells of one query after the other. For the first crossings of an isovalue it
/// searches the whole series once and keeps the result, two bytes for each cell of the grid, until
/// a query does not need it; cells of a grid with wide ids are too many for that, and get kNoColor.
/// Not thread-safe.
class SurfaceColors {
  public:
    /// @param method of the searches, none: the cheapest; the file must have that tier
    SurfaceColors(std::shared_ptr<const IndexFile> file, std::optional<SearchMethod> method);

    /// Fills `out` and `corners` as `Extraction::colors` and `corner_colors` are.
    /// @param step of the query
    /// @return false when it was stopped and they are incomplete
    /// @throws Error as loading a step and the search for first crossings do
    bool fill(const SurfacesQuery& query, const std::vector<CellSet>& surfaces,
              const StepView& step, std::vector<std::uint16_t>& out,
              std::vector<std::uint16_t>& corners, const std::stop_token& stop);

  private:
    void forget_all_but(const SurfacesQuery& query);
    const FirstCrossings* crossings(double isovalue, const std::stop_token& stop);

    std::shared_ptr<const IndexFile> file_;
    std::optional<SearchMethod> method_;
    LayerSearch layers_;
    std::vector<FirstCrossingsPtr> crossings_; ///< of the last query's isovalues
};

} // namespace isochron::index
