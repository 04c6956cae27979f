// The extremes of cells, as keys.
#pragma once

#include "index/volume/order_key.h"
#include "index/volume/step_values.h"

#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// Computes the extremes of a row of cells at a time. Keeps its work space: one for each thread.
class CellExtremes {
  public:
    explicit CellExtremes(const StepValues& values);

    /// Extremes of the cells (0..nx-2, y, z) at a step. A cell with a NaN vertex has no extremes
    /// and gets `low` 1 and `high` 0; all others have `low <= high`.
    void row(std::size_t step, std::uint32_t y, std::uint32_t z, std::span<OrderKey> low,
             std::span<OrderKey> high);

  private:
    StepValues values_;
    KeyMap keys_;
    std::vector<std::byte> columns_low_, columns_high_; ///< stored values, of any type
    std::vector<std::uint8_t> columns_nan_;
};

} // namespace isochron::index
