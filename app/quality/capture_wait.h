// Decides when a wanted capture is taken: it waits for its cells and for their final quality.
#pragma once

#include "index/volume/query.h"
#include "interaction/input/tracked_input.h"

#include <optional>

namespace isochron::app {

/// The state of one frame, as far as a capture depends on it.
struct CaptureView {
    interaction::Seconds time{0}; ///< session time
    index::SurfacesQuery asked;
    std::optional<index::SurfacesQuery> shown; ///< empty before the first cells
    bool failed = false;                       ///< the cells asked for will not come
    bool final = false;                        ///< the picture is as good as it gets
};

/// A picture is taken once it shows the cells asked for at final quality. In endless motion (time
/// plays in a loop, a restless head) the wait ends after `kPatience`, and the next picture is
/// taken.
/// Time spent on cells does not count: once a query has not changed for `kSteady`, its cells are
/// waited for as long as they take.
class CaptureWait {
  public:
    static constexpr interaction::Seconds kPatience{10};
    static constexpr interaction::Seconds kSteady{1}; ///< without a change of the query

    void ask() { ++wanted_; }
    int wanted() const { return wanted_; }

    /// Called once per frame. @return true: take one capture now; it then counts as taken
    bool take(const CaptureView& now);

  private:
    int wanted_ = 0;
    std::optional<CaptureView> before_;
    interaction::Seconds asked_since_{0}; ///< when the newest query was first asked
    interaction::Seconds waited_{0};      ///< for an end of motion
};

} // namespace isochron::app
