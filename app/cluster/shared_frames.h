// The frames that the processes of a cluster show together, seen from one of them.
//
// A frame of rank 0 goes out as an order; the others obey it. All draw with rank 0's choice of a
// footprint, answer how far they are, and show the frame when everybody has answered.
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
    /// Rank 0 begins a frame, or ends them; the others take part in it, until there are no more.
    /// @return on rank 0 the heads that all are told: all walls are seen from the same
    Latch begin(const interaction::InputState& input, const interaction::Commands& commands,
                Waiting waiting, const Latch& latch,
                const stereo::Installation& installation) override;
    std::optional<FrameOrder> next() override;
    void end() override;

    /// A live frame asks for what all ask for, and shows what all show; on its way to the GPU is
    /// what all will show next.
    index::SurfacesQuery ask(index::SurfacesQuery wanted, Waiting waiting) override;
    CellsInFrame cells(const index::Extractor& extractor, const index::ExtractionPtr& shown,
                       Waiting waiting) override;
    void staged() override { cells_.staged(); }
    /// With the name of the process; alike in all.
    std::string failure(const index::Extractor& extractor) const override;
    bool has_no_answer(const index::Extractor& extractor) const override;

    std::vector<DrawSample> samples(std::vector<DrawSample> mine) override;
    DrawLoad largest(const DrawLoad& mine) const override;
    std::uint64_t surface_limit() const override;
    /// What rank 0 chose.
    FrameChoice agree(const FrameChoice& mine) override;

    /// @param mine cells and samples are filled in here
    void swap_barrier(const std::function<FrameAnswer()>& mine) override;
    bool close_wanted() const override;

  private:
    /// A frame of which not all have told their times.
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
    std::vector<DrawSample> samples_;  ///< of this process, that the others have not been told of
    std::deque<Sampled> sampled_;
};

} // namespace isochron::app
