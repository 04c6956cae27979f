// Decides when a capture that was asked for may be taken: it waits for the cells and for quality.
#pragma once

#include "index/volume/query.h"
#include "interaction/tracked_input.h"

#include <optional>

namespace isochron::app {

/// What a capture waits for, in one frame.
struct CaptureView {
    interaction::Seconds time{0}; ///< session time
    index::SurfacesQuery asked;
    std::optional<index::SurfacesQuery> shown; ///< empty before the first cells
    bool failed = false;                       ///< what was asked for will not come
    bool final = false;                        ///< the picture is as good as it gets
};

/// A picture is taken once it shows what was asked for at its final quality. In motion that does
/// not end (time that plays in a loop, a restless head) this is waited for no longer than the
/// patience; then the next picture is taken. Cells are waited for as long as they take, once their
/// query has stood for a moment.
class CaptureWait {
  public:
    static constexpr interaction::Seconds kPatience{10};
    static constexpr interaction::Seconds kSteady{1}; ///< a query that no longer changes

    void ask() { ++wanted_; }
    int wanted() const { return wanted_; }

    /// Once per frame. @return true: take one now, which is then no longer wanted
    bool take(const CaptureView& now);

  private:
    int wanted_ = 0;
    std::optional<CaptureView> before_;
    interaction::Seconds asked_since_{0}; ///< when the newest query was first asked
    interaction::Seconds waited_{0};      ///< for what motion withholds
};

} // namespace isochron::app
