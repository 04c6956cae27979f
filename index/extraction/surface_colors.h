// Computes the color coordinates of an extraction's cells.
#pragma once

#include "index/search/first_crossing.h"
#include "index/search/layer_search.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// Colors by value of an earlier extraction, some of which stay.
struct KnownColors {
    struct Surface {
        /// Each cell's place in the earlier surface, or EarlierMesh::kNone where its colors may
        /// have changed; empty: none is kept.
        std::span<const std::uint32_t> places;
        std::size_t first = 0; ///< place of the earlier surface's first cell among all cells
    };
    /// Colors of all surfaces; empty: nothing is known.
    std::span<const std::uint16_t> colors, corners;
    std::vector<Surface> surfaces = {};
};

/// Colors the cells of one query after the other. For the first crossings of an isovalue it
/// searches the whole series once and keeps the result, two or four bytes for each cell, until
/// a query does not need it; cells of a grid with wide ids are too many for that, and get kNoColor.
/// Not thread-safe.
class SurfaceColors {
  public:
    /// @param method of the searches, none: the cheapest; the file must have that tier
    SurfaceColors(std::shared_ptr<const IndexFile> file, std::optional<SearchMethod> method);

    /// Fills `out` and `corners` as `Extraction::colors` and `corner_colors` are.
    /// @param step of the query @param known colors that cells may keep
    /// @return false when it was stopped and they are incomplete
    /// @throws Error as loading a step and the search for first crossings do
    bool fill(const SurfacesQuery& query, const std::vector<CellSet>& surfaces,
              const StepView& step, std::vector<std::uint16_t>& out,
              std::vector<std::uint16_t>& corners, const std::stop_token& stop,
              const KnownColors& known = {});

  private:
    /// The colors of one surface.
    struct Part {
        std::span<std::uint16_t> colors, corners;
    };
    bool fill_others(const StepView& step, const CellSet& surface, const ColorSource& source,
                     const KnownColors& known, const KnownColors::Surface& earlier,
                     const Part& part, const std::stop_token& stop);
    void forget_all_but(const SurfacesQuery& query);
    const FirstCrossings* crossings(double isovalue, bool blended, const std::stop_token& stop);

    std::shared_ptr<const IndexFile> file_;
    std::optional<SearchMethod> method_;
    LayerSearch layers_;
    std::vector<FirstCrossingsPtr> crossings_; ///< first crossings of the last query's isovalues
};

} // namespace isochron::index
