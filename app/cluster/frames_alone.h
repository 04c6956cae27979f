// The frames of a process that does not share them: cells are shown as soon as they come.
#pragma once

#include "app/cluster/frame_sharing.h"

namespace isochron::app {

class FramesAlone : public FrameSharing {
  public:
    bool leads() const override { return true; }
    bool alone() const override { return true; }
    Latch begin(const interaction::InputState& input, const interaction::Commands& commands,
                Waiting waiting, const Latch& latch,
                const stereo::Installation& installation) override;
    std::optional<FrameOrder> next() override { return std::nullopt; }
    void end() override {}
    index::SurfacesQuery ask(index::SurfacesQuery wanted, Waiting waiting) override;
    CellsInFrame cells(const index::Extractor& extractor, const index::ExtractionPtr& shown,
                       Waiting waiting) override;
    void staged() override {}
    std::string failure(const index::Extractor& extractor) const override;
    bool has_no_answer(const index::Extractor& extractor) const override;
    std::vector<DrawSample> samples(std::vector<DrawSample> mine) override { return mine; }
    DrawLoad largest(const DrawLoad& mine) const override { return mine; }
    std::uint64_t surface_limit() const override;
    bool parts_are_whole() const override { return true; }
    Milliseconds parts_took(Milliseconds mine) const override { return mine; }
    FramePlan agree(const FramePlan& mine) override { return mine; }
    void swap_barrier(const std::function<FrameAnswer()>&) override {}
    bool close_wanted() const override { return false; }
};

} // namespace isochron::app
