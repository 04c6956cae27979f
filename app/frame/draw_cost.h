// The cost of drawing: predicts one footprint's time from cells and pixels; forgets old frames.
#pragma once

#include "app/frame/milliseconds.h"

#include <optional>

namespace isochron::app {

/// The amount that one frame draws, summed over all eyes and windows.
struct DrawLoad {
    double cells = 0;  ///< each counted once per view
    double pixels = 0; ///< of the views
    bool operator==(const DrawLoad&) const = default;
};

/// `time = a * pixels + b * cells` with a, b >= 0, fitted to the measurements by weighted least
/// squares in which older ones weigh less. If the measurements cannot tell the two parts apart
/// (all have the same load), each part gets half of the time.
class DrawCost {
  public:
    void add(const DrawLoad& load, Milliseconds time);
    void forget() { *this = {}; }

    /// Empty before the first measurement.
    std::optional<Milliseconds> predict(const DrawLoad& load) const;

  private:
    /// Sums over the measurements, weighted by age.
    double weight_ = 0;
    double pixels_ = 0, cells_ = 0;
    double pixels_pixels_ = 0, pixels_cells_ = 0, cells_cells_ = 0;
    double pixels_time_ = 0, cells_time_ = 0, time_ = 0;
};

} // namespace isochron::app
