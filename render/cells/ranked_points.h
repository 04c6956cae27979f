// The points of a set that comes with its normals: all are sent to the GPU, in order of rank.
#pragma once

#include "index/extraction/extraction.h"
#include "render/cells/slot_assignment.h"

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

    /// The next points, at most so many, with their styles; valid until the next call.
    std::span<const index::CellPoint> next(std::size_t most);
    /// Number of points that `next` gave so far.
    std::size_t given() const { return slots_.places.size(); }

    /// Once all points are given.
    Slots take() { return std::move(slots_); }

  private:
    const index::Extraction* set_;
    std::size_t surface_ = 0, at_ = 0; ///< next cell
    std::vector<index::CellPoint> given_;
    Slots slots_;
};

} // namespace isochron::render
