// In how many pixels the cells of a moving picture are drawn, where all pixels take too long.
#pragma once

#include "app/frame/cell_resolutions.h"
#include "app/frame/milliseconds.h"
#include "app/quality/dwell.h"
#include "interaction/input/tracked_input.h"

#include <array>
#include <cstddef>
#include <optional>

namespace isochron::app {

/// Chooses by the cost of drawing in all pixels, and by the share of it that fewer pixels took.
class CellResolution {
  public:
    /// Number of the resolution down to which pixels are given up before cells are.
    static constexpr std::size_t kBeforeCells = 2;

    /// @param least share of width and height that is drawn: 1 gives up no pixel
    explicit CellResolution(double least = 0);

    /// @param step number of a resolution @param share of the expected cost of all pixels
    /// @return the share that is thought right: `share`, unless fewer pixels can hardly save or cost
    /// so much. Then the expected cost of all pixels was wrong, and nothing is learnt here.
    double learn(std::size_t step, double share);
    double share(std::size_t step) const { return shares_[step]; }

    /// @param expected cost of drawing in all pixels; empty: not known
    /// @param now session time @return number of a resolution
    std::size_t choose(const std::optional<Milliseconds>& expected, Milliseconds budget,
                       interaction::Seconds now);

  private:
    std::array<double, kCellResolutions.size()> shares_{1.0, 0.8, 0.65, 0.55}; ///< until measured
    std::size_t count_ = 1; ///< number of resolutions that may be taken
    std::array<bool, kCellResolutions.size()> measured_{};
    Dwell<std::size_t> step_;
};

} // namespace isochron::app
