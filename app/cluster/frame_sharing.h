// How a session shares its frames: not at all, or with the other processes of a cluster.
//
// A session always has one of these and does not ask which. FramesAlone costs nothing and never
// waits; SharedFrames makes all processes show the same.
#pragma once

#include "app/cluster/cluster_messages.h"
#include "app/frame/late_latch.h"
#include "index/extraction/extractor.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// Which sets of cells a frame shows and uploads.
struct CellsInFrame {
    /// The set to show as soon as it is on the GPU; it may be null. Empty: no change.
    std::optional<index::ExtractionPtr> show;
    index::ExtractionPtr stage; ///< set to upload without showing it; null: none
};

class FrameSharing {
  public:
    virtual ~FrameSharing() = default;

    /// Whether this process (rank 0) reads the devices and shows the operator's panel.
    virtual bool leads() const = 0;

    /// Whether there is no other process.
    virtual bool alone() const = 0;

    /// Begins a frame; rank 0 also sends its order to the others.
    /// @return the latch to ask for the heads when the views are made; may be empty
    virtual Latch begin(const interaction::InputState& input, const interaction::Commands& commands,
                        Waiting waiting, const Latch& latch,
                        const stereo::Installation& installation) = 0;
    /// The next frame to take part in, for ranks above 0; empty: there are no more.
    virtual std::optional<FrameOrder> next() = 0;
    /// Rank 0 tells the others that there are no more frames.
    virtual void end() = 0;

    /// @return the query to extract now, when the session wants `wanted`
    virtual index::SurfacesQuery ask(index::SurfacesQuery wanted, Waiting waiting) = 0;
    /// @param shown set that is drawn now; may be null
    virtual CellsInFrame cells(const index::Extractor& extractor, const index::ExtractionPtr& shown,
                               Waiting waiting) = 0;
    /// Call when the set to stage is on the GPU.
    virtual void staged() = 0;
    /// Why a process has no cells; empty when all is well.
    virtual std::string failure(const index::Extractor& extractor) const = 0;
    /// Whether the newest query has failed, so that no answer will come.
    virtual bool has_no_answer(const index::Extractor& extractor) const = 0;

    /// Passes on the draw times of this process.
    /// @return frames whose times are known from all processes, in order, each with the slowest
    /// process's time and the largest load
    virtual std::vector<DrawSample> samples(std::vector<DrawSample> mine) = 0;
    /// The load of one cell in every view, on the process that draws most.
    virtual DrawLoad largest(const DrawLoad& mine) const = 0;
    /// Most cells that all processes can draw as exact surfaces; no limit for a process alone,
    /// which knows its own.
    virtual std::uint64_t surface_limit() const = 0;
    /// Whether a picture in parts may be shown once it is whole here: it is whole everywhere.
    virtual bool parts_are_whole() const = 0;
    /// The time of that picture in the process that took longest.
    virtual Milliseconds parts_took(Milliseconds mine) const = 0;
    /// @param mine used on rank 0 @return rank 0's plan, which all processes follow
    virtual FramePlan agree(const FramePlan& mine) = 0;

    /// Returns when all processes have drawn the frame.
    /// @param mine makes this process's answer; called only if there are other processes
    virtual void swap_barrier(const std::function<FrameAnswer()>& mine) = 0;
    /// Whether the user wants to close a window of some process in the cluster.
    virtual bool close_wanted() const = 0;
};

} // namespace isochron::app
