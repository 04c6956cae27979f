// How a session shares its frames: with nobody, or with the other processes of a cluster.
//
// A session always has one of these and does not ask which: FramesAlone costs nothing and waits for
// nobody, SharedFrames makes all processes show the same.
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

/// What a frame does about cells.
struct CellsInFrame {
    /// The set that is shown as soon as it is on the GPU, which may be null; empty: as before.
    std::optional<index::ExtractionPtr> show;
    index::ExtractionPtr stage; ///< goes to the GPU without being shown; null: none
};

class FrameSharing {
  public:
    virtual ~FrameSharing() = default;

    /// This process reads the devices, and the operator's panel lies over its first window.
    virtual bool leads() const = 0;

    /// Begins a frame: the others are told, if this process leads.
    /// @return who tells where the heads are when the views are made; may be empty
    virtual Latch begin(const interaction::InputState& input, const interaction::Commands& commands,
                        Waiting waiting, const Latch& latch,
                        const stereo::Installation& installation) = 0;
    /// The next frame to take part in, for a process that does not lead; empty: there are no more.
    virtual std::optional<FrameOrder> next() = 0;
    /// There are no more frames, if this process leads.
    virtual void end() = 0;

    /// @return the query to work on where this one is wanted
    virtual index::SurfacesQuery ask(index::SurfacesQuery wanted, Waiting waiting) = 0;
    /// @param shown the set that is drawn; may be null
    virtual CellsInFrame cells(const index::Extractor& extractor, const index::ExtractionPtr& shown,
                               Waiting waiting) = 0;
    /// The set to stage is on the GPU.
    virtual void staged() = 0;
    /// Why a process has no cells; empty when all is well.
    virtual std::string failure(const index::Extractor& extractor) const = 0;
    /// The newest query will not be answered.
    virtual bool has_no_answer(const index::Extractor& extractor) const = 0;

    /// Passes on what frames of this process took.
    /// @return frames whose times are known of all, each as the slowest took it; in their order
    virtual std::vector<DrawSample> samples(std::vector<DrawSample> mine) = 0;
    /// Of one cell in every view, on the process that draws most.
    virtual DrawLoad largest(const DrawLoad& mine) const = 0;
    /// Cells that all processes can draw as exact surfaces; a process alone knows its own limit.
    virtual std::uint64_t surface_limit() const = 0;
    /// @param mine counts where it leads @return what all draw with
    virtual FrameChoice agree(const FrameChoice& mine) = 0;

    /// Returns when all have drawn the frame.
    /// @param mine asked for where there is somebody to tell
    virtual void swap_barrier(const std::function<FrameAnswer()>& mine) = 0;
    /// The user of another process wants to close a window.
    virtual bool close_wanted() const = 0;
};

} // namespace isochron::app
