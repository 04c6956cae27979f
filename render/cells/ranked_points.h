// The points of a set that comes with its normals: sent to the GPU as a whole, in order of rank.
#pragma once

#include "index/extraction/extraction.h"
#include "render/cells/slot_plan.h"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace isochron::render {

/// Every cell's slot is its rank. Normals change from step to step even in cells that stay, so
/// keeping slots would save nothing.
class RankedPoints {
  public:
    /// @param set lives as long as this
    explicit RankedPoints(const index::Extraction& set);

    /// Copies at most `cells` points. @return true when all are copied
    bool copy(std::size_t cells);

    // Once all are copied:
    std::span<const index::CellPoint> points() const { return points_; } ///< with their styles
    Slots take() { return std::move(slots_); }

  private:
    const index::Extraction* set_;
    std::size_t surface_ = 0, at_ = 0; ///< next cell to copy
    std::vector<index::CellPoint> points_;
    Slots slots_;
};

} // namespace isochron::render
