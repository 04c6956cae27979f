// What drawing costs: a forgetful model of one footprint's time by cells and pixels.
#pragma once

#include "app/frame/milliseconds.h"

#include <optional>

namespace isochron::app {

/// What one frame draws, of all its eyes and windows together.
struct DrawLoad {
    double cells = 0;  ///< each counted once per view
    double pixels = 0; ///< of the views
    bool operator==(const DrawLoad&) const = default;
};

/// `time = a * pixels + b * cells` with a, b >= 0, fitted to what was measured by weighted least
/// squares in which every measurement weighs less than the next. Where the measurements do not tell
/// the two parts apart (all of one load), each gets half.
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
