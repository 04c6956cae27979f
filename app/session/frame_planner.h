// Chooses how a frame's picture is drawn, and agrees on it with the other processes of a cluster:
// the frame's plan.
#pragma once

#include "app/choice/cell_supply.h"
#include "app/choice/frame.h"
#include "app/frame/frame_log.h"
#include "app/output/outputs.h"
#include "app/scene/scene.h"
#include "app/session/picture_maker.h"

namespace isochron::app {

class FramePlanner {
  public:
    /// All outlive the choice.
    FramePlanner(const Config& config, const Outputs& outputs, FrameLog& log, const Scene& scene,
                  CellSupply& supply, const PictureMaker& pictures);

    FrameQuality& quality() { return quality_; }
    const FrameQuality& quality() const { return quality_; }

    /// Makes the plan of a frame, and completes its picture and its report by it.
    /// @param now gets its footprint, and the cells that it shows
    void choose(const Frame& frame, Picture& now);

  private:
    /// What a plan is made from.
    struct Options {
        bool changed; ///< what the eyes see has changed, apart from the footprint
        render::FootprintSet available, possible;
    };

    void learn_costs(const Frame& frame);
    bool only_gets_finer(const Frame& frame, const Picture& now) const;
    bool is_only_laid_out(const Frame& frame, const Picture& now) const;
    render::FootprintSet ready(const Frame& frame, render::FootprintSet all) const;
    Options options(const Frame& frame, bool changed) const;
    FramePlan wanted(const Frame& frame, const Options& options);
    void choose_mesh(const Frame& frame, FramePlan& plan);
    bool moves_exact(const Frame& frame, const Picture& now, const FramePlan& plan) const;
    bool grows_old(const Picture& now) const;
    bool shows_layer_again(const Frame& frame, const Picture& now);
    bool only_awaits_cells(const Frame& frame, const Picture& now) const;
    void show_last(const Frame& frame) const;
    void agree(const Frame& frame, FramePlan plan);
    void rest_in_parts(const Frame& frame, Picture& now) const;

    const Outputs& outputs_;
    FrameLog& log_;
    const Scene& scene_;
    const CellSets& sets_;
    CellSupply& supply_;
    const PictureMaker& pictures_;
    FrameQuality quality_;
    std::optional<interaction::Seconds> again_since_; ///< a layer was first shown again
};

} // namespace isochron::app
