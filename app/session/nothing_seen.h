// Watches whether the picture shows a surface, says why it does not, and surveys the step that is
// shown.
#pragma once

#include "app/choice/frame.h"
#include "app/frame/empty_picture.h"
#include "app/output/outputs.h"
#include "app/scene/data_sight.h"
#include "app/session/shown_arrays.h"
#include "app/session/step_surveyor.h"
#include "index/extraction/extraction.h"
#include "interaction/pose.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

namespace isochron::app {

class NothingSeen {
  public:
    /// All outlive it.
    NothingSeen(const ShownArrays& arrays, const Outputs& outputs)
        : arrays_(arrays), outputs_(outputs) {}
    void set_wake(std::function<void()> wake) { surveyor_.set_wake(std::move(wake)); }

    /// What decides what the eyes see.
    struct Seen {
        const index::ExtractionPtr& cells; ///< drawn cells; may be null
        const Audience& audience;
        bool in_window; ///< one window at a desk shows all that is seen
        /// Where the data are ahead of the viewer, and whole.
        interaction::Similarity all_in_view;
    };
    /// Called once a frame, when it is known how it is drawn.
    void update(const Frame& frame, const Seen& seen);

    /// Why the last frame's picture shows nothing; empty: it shows something, or changes.
    const std::optional<EmptyPicture>& why() const { return why_; }
    /// The survey of the last frame's step; null while there is none.
    const StepSurvey* survey() const { return surveyor_.survey(); }

  private:
    /// The picture for which all cells were looked at last.
    struct Known {
        std::uint64_t extraction = 0; ///< number of the extraction
        std::uint32_t visible = 0;    ///< a bit for each surface
        std::vector<interaction::ClipPlane> cuts;
        std::optional<BoxCorners> box;
        bool cut_away = false;
    };

    void know(const index::Extraction& cells, const index::Grid& grid, const ExplorerState& state);
    Sight sight(const Frame& frame, const Seen& seen) const;

    const ShownArrays& arrays_;
    const Outputs& outputs_;
    StepSurveyor surveyor_;
    std::optional<Known> known_;
    std::optional<EmptyPicture> why_;
};

} // namespace isochron::app
