// The frames that the processes of a cluster show together, seen from one of them.
//
// A frame of rank 0 goes out as an order; the others obey it. All draw with rank 0's choice of a
// footprint, answer how far they are, and show the frame when everybody has answered.
#pragma once

#include "app/cluster/cluster_messages.h"
#include "stereo/cluster.h"

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

class SharedFrames {
  public:
    /// @param cluster outlives this
    explicit SharedFrames(stereo::Cluster& cluster) : cluster_(cluster) {}

    bool leads() const { return cluster_.rank() == 0; }
    unsigned rank() const { return cluster_.rank(); }
    unsigned size() const { return cluster_.size(); }

    /// Rank 0 begins a frame, or ends them; the others take part in it, until there are no more.
    void begin(const interaction::InputState& input, const interaction::Commands& commands,
               Waiting waiting, const interaction::InputState& latched);
    void end() { tell(encoded_end()); }
    std::optional<FrameOrder> next();

    /// What rank 0 chose.
    /// @param mine counts on rank 0 only
    FrameChoice agree(const FrameChoice& mine);

    /// Returns when all have drawn the frame.
    void swap_barrier(FrameAnswer mine);

    /// Somebody wants to close a window.
    bool close_wanted() const;
    /// Why one of them has no cells, with its name; empty when all have them.
    std::string failure() const;
    /// Of the process that draws most.
    DrawLoad view() const;
    /// Cells that all can draw as exact surfaces.
    std::uint64_t surface_limit() const;
    /// Frames of which all have told the times now, each as the slowest took it; in their order.
    std::vector<DrawSample> samples();

    SharedCells& cells() { return cells_; }

  private:
    /// A frame of which not all have told their times.
    struct Sampled {
        DrawSample slowest;
        unsigned told = 0;
    };

    void tell(const MessageBytes& bytes);

    stereo::Cluster& cluster_;
    CellAgreement agreement_;
    SharedCells cells_;
    std::vector<FrameAnswer> answers_; ///< to the last frame, by rank
    std::deque<Sampled> sampled_;
};

} // namespace isochron::app
