// A set of cells on its way to the GPU: its points, or how it differs from the shown set.
#pragma once

#include "index/extraction/extraction.h"
#include "render/cells/ranked_points.h"
#include "render/cells/slot_assignment.h"
#include "render/cells/upload_count.h"
#include "render/gl/device_array.h"
#include "render/gl/staging_ring.h"

#include <cstddef>
#include <memory>

namespace isochron::render {

/// Bytes that may be sent in a frame, and how many were.
struct SendBudget {
    std::size_t bytes, sent = 0;
    std::size_t left() const { return bytes - sent; }
};

/// Sends the cells of a set: their points, or the differences from the shown set. CellBuffers sends
/// the blocks of its volume and its mesh.
class ArrivingSet {
  public:
    explicit ArrivingSet(const Gl& gl);

    /// Begins with a set.
    /// @param assignment how the set differs from the shown one; null: the set comes with its points
    void begin(index::ExtractionPtr set, std::unique_ptr<SlotAssignment> assignment);
    /// Gives the set up, or ends when it is shown; `set` is null from then on. @return the set
    index::ExtractionPtr end();

    /// Null while nothing arrives.
    const index::ExtractionPtr& set() const { return set_; }
    bool comes_with_points() const { return ranked_ != nullptr; }

    /// Sends points, or finds how the set differs, for at most about a millisecond.
    /// @return whether all points are on the GPU, or the differences are known
    bool send_points(SendBudget& budget, UploadCount& count);
    /// Sends the differences and the styles of a set without points.
    /// @return whether all are on the GPU
    bool send_changes(StagingRing& ring, SendBudget& budget, UploadCount& count);

    /// Puts the sent points in place of these; for a set with points that are all sent.
    /// @return the slots of the cells
    Slots swap_points(DeviceArray& points);
    /// For a set without points, when all changes are sent.
    SlotAssignment& assignment() { return *assignment_; }
    const DeviceArray& message() const { return message_; } ///< changed cells, for CellCompute
    /// Styles of all cells, by slot, for CellCompute.
    const DeviceArray& styles() const { return styles_; }

    static DeviceArray points_array(const Gl& gl); ///< a buffer of index::CellPoint

  private:
    bool send_message(StagingRing& ring, SendBudget& budget, UploadCount& count);
    bool send_styles(StagingRing& ring, SendBudget& budget, UploadCount& count);

    const Gl* gl_;
    DeviceArray points_;  ///< points of a set that comes with its points
    DeviceArray message_; ///< changed cells of another set
    DeviceArray styles_;
    index::ExtractionPtr set_;
    std::unique_ptr<RankedPoints> ranked_;       ///< if the set comes with its points
    std::unique_ptr<SlotAssignment> assignment_; ///< else
    bool merged_ = false;                        ///< whether `send_points` is done
    std::size_t words_sent_ = 0, styles_sent_ = 0;
};

} // namespace isochron::render
