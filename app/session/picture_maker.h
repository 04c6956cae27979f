// Makes the picture of a frame: from the state, the viewers and the cells that are shown.
#pragma once

#include "app/choice/frame.h"
#include "app/choice/further_supply.h"
#include "app/choice/ghost_supply.h"
#include "app/choice/model_supply.h"
#include "app/choice/slice_supply.h"
#include "app/config/config.h"
#include "app/output/outputs.h"
#include "app/scene/cell_sets.h"
#include "app/scene/picture.h"
#include "app/session/picker.h"
#include "app/session/session_panel.h"
#include "app/session/shown_arrays.h"

#include <optional>
#include <utility>
#include <vector>

namespace isochron::app {

class PictureMaker {
  public:
    /// All outlive the maker.
    PictureMaker(const Config& config, const ShownArrays& arrays, const CellSets& sets,
                 const Outputs& outputs, const SessionPanel& panel, const Picker& picker,
                 const SliceSupply& slices, const ModelSupply& models, const GhostSupply& ghosts,
                 const FurtherSupply& further)
        : config_(config), arrays_(arrays), sets_(sets), outputs_(outputs), panel_(panel),
          picker_(picker), slices_(slices), models_(models), ghosts_(ghosts), further_(further) {}

    /// The picture of this frame, with the footprint of the last one.
    /// @param seen devices that the views are made from
    Picture make(const Frame& frame, const interaction::InputState& seen);
    /// One before the first frame, without anything that devices or data give.
    Picture first(const ExplorerState& state) const;
    /// Continues with the cells that are shown now.
    void show_cells(Picture& picture, const ExplorerState& state) const;
    /// What pictures that are written show, with what the configuration says of them.
    interaction::WrittenPictures written(const interaction::WrittenPictures& asked) const;
    /// The picture as it is kept.
    Picture kept(const Picture& picture, const interaction::WrittenPictures& asked) const;
    /// What is to be drawn over the last picture, which lacks it.
    const Aids& over() const { return over_; }

    /// Sets what stands over the pictures from now on.
    void set_title(Title title) { title_ = std::move(title); }
    /// The place on a surface under the cursor.
    std::optional<interaction::Pointed> pointed(const interaction::InputState& input,
                                                const ExplorerState& state) const;
    /// Value, place and time under the cursor, or else of the mark; empty if there is neither.
    std::string words_under_pointer(const interaction::InputState& input,
                                    const ExplorerState& state) const;

    /// Whether the windows are on a desktop rather than walls: there users need help with orientation.
    bool on_desktop(const Audience& audience) const;
    std::optional<ColorScale> scale(const ExplorerState& state) const;
    /// Where the viewers' eyes are.
    std::vector<stereo::ViewerPose> viewers(const interaction::InputState& input,
                                            const ExplorerState& state) const;

  private:
    std::optional<ColorScale> shown_scale(const ExplorerState& state) const;
    ShownValues shown_values(const ExplorerState& state) const;
    bool colored_as_asked(const ExplorerState& state) const;
    bool in_windows(const FrameReport& report);
    bool on_screens_of_desk() const;
    bool lifts_background(const Frame& frame, const Audience& audience) const;
    float text_share(const ExplorerState& state) const;
    Aids aids(const interaction::InputState& input, const ExplorerState& state) const;
    bool aids_lie_over(const ExplorerState& state) const;

    const Config& config_;
    const ShownArrays& arrays_;
    const CellSets& sets_;
    const Outputs& outputs_;
    const SessionPanel& panel_;
    const Picker& picker_;
    const SliceSupply& slices_;
    const ModelSupply& models_;
    const GhostSupply& ghosts_;
    const FurtherSupply& further_;
    mutable PercentileRange percentiles_; ///< keeps what it has sorted
    Aids over_;
    Title title_;
    std::optional<interaction::Seconds> in_headset_; ///< when a headset last wanted a picture
};

} // namespace isochron::app
