// The cost of drawing: predicts one footprint's time from cells and pixels; forgets old frames.
#pragma once

#include "app/frame/milliseconds.h"

#include <optional>

namespace isochron::app {

/// The amount that one frame draws, summed over all eyes and windows.
struct DrawLoad {
    double cells = 0;  ///< each counted once for each view and each pass over the cells
    double pixels = 0; ///< pixels of the views
    bool operator==(const DrawLoad&) const = default;
};

/// `time = a * pixels + b * cells` with a, b >= 0, by recursive least squares with directional
/// forgetting (Cao and Schwartz, A directional forgetting algorithm based on the decomposition of
/// the information matrix, Automatica 36, 2000, doi:10.1016/S0005-1098(00)00093-5). A measurement
/// makes older ones count for less only where both tell the same: many frames with one load do not
/// wipe out what is known about how the time changes with the load. Where nothing is known about
/// this change, or loads differ by less than times scatter, an unexpected time is charged to pixels
/// and cells in equal shares.
class DrawCost {
  public:
    void add(const DrawLoad& load, Milliseconds time);
    void forget() { *this = {}; }

    /// Empty before the first measurement; for a load with cells, before the first one with cells.
    std::optional<Milliseconds> predict(const DrawLoad& load) const;

  private:
    double of_pixel_ = 0, of_cell_ = 0; ///< [ms]; may be below 0
    /// Sums of products of the loads, with what is forgotten taken off: the information matrix.
    double pixels_pixels_ = 0, pixels_cells_ = 0, cells_cells_ = 0;
    double most_cells_ = 0; ///< most cells of a measurement
    bool measured_ = false;
};

} // namespace isochron::app
