// The frames that the processes of a cluster show together, as one of them sees it.
//
// Rank 0 sends each frame as an order, which the others obey. All draw with the footprint that
// rank 0 chose, answer how far they are, and show the frame when all have answered.
#pragma once

#include "app/cluster/frame_sharing.h"
#include "stereo/cluster.h"

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

class SharedFrames final : public FrameSharing {
  public:
    /// @param cluster outlives this
    explicit SharedFrames(stereo::Cluster& cluster) : cluster_(cluster) {}

    bool leads() const override { return cluster_.rank() == 0; }
    bool alone() const override { return cluster_.size() == 1; }
    /// Rank 0 calls `begin` for each frame and `end` at last; the others call `next` and `begin`.
    /// @return on rank 0 a latch with the heads that were sent to all, so that all walls are drawn
    /// for the same heads; on the others `latch`
    Latch begin(const interaction::InputState& input, const interaction::Commands& commands,
                Waiting waiting, const Latch& latch,
                const stereo::Installation& installation) override;
    std::optional<FrameOrder> next() override;
    void end() override;

    /// In a live frame all processes ask the same query and show the same set, and upload the set
    /// that all will show next.
    index::SurfacesQuery ask(index::SurfacesQuery wanted, Waiting waiting) override;
    CellsInFrame cells(const index::Extractor& extractor, const index::ExtractionPtr& shown,
                       Waiting waiting) override;
    void staged() override { cells_.staged(); }
    /// The first failure by rank, with the process's name; the same text in all processes.
    std::string failure(const index::Extractor& extractor) const override;
    bool has_no_answer(const index::Extractor& extractor) const override;

    std::vector<DrawSample> samples(std::vector<DrawSample> mine) override;
    DrawLoad largest(const DrawLoad& mine) const override;
    std::uint64_t surface_limit() const override;
    /// By the answers to the last frame.
    bool parts_are_whole() const override;
    Milliseconds parts_took(Milliseconds mine) const override;
    FramePlan agree(const FramePlan& mine) override;

    /// @param mine cells and samples are filled in here
    void swap_barrier(const std::function<FrameAnswer()>& mine) override;
    bool close_wanted() const override;

  private:
    /// A frame whose times not all processes have sent yet.
    struct Sampled {
        DrawSample slowest;
        unsigned told = 0;
    };

    void tell(const MessageBytes& bytes);
    void take_note_of(const DrawSample& sample);

    stereo::Cluster& cluster_;
    CellAgreement agreement_;
    SharedCells cells_;
    std::vector<FrameAnswer> answers_; ///< to the last frame, by rank
    std::vector<DrawSample> samples_;  ///< samples of this process, not yet sent to the others
    std::deque<Sampled> sampled_;
};

} // namespace isochron::app
