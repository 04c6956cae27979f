// Decides when a wanted capture is taken: it waits for its cells and for their final quality.
#pragma once

#include "app/frame/frame_report.h"

#include <optional>
#include <string>

namespace isochron::app {

/// The state of one frame, as far as a capture depends on it.
struct CaptureView {
    interaction::Seconds time{0}; ///< session time
    index::SurfacesQuery asked;
    std::optional<index::SurfacesQuery> shown; ///< empty before the first cells
    bool failed = false;                       ///< the cells asked for will not come
    bool final = false;                        ///< the picture is as good as it gets
    bool improves = false; ///< nothing moves, and cells or parts of a better picture are being made

    /// @param failed the cells asked for will not come
    static CaptureView of(const FrameReport& frame, bool failed);
    /// Whether the cells asked for are there, or all that will come.
    bool has_cells() const { return shown == asked || (failed && shown); }
    bool is_final() const { return final && has_cells(); }
};

/// A picture is taken once it shows the cells asked for at final quality. In endless motion (time
/// plays in a loop, a restless head) the wait ends after `kPatience`, and the next picture is
/// taken.
/// Only time in which a capture is wanted counts: a session may have waited for hours before.
/// Time spent on cells and on parts of the picture does not count: once a query has not changed for
/// `kSteady`, they are waited for as long as they take.
class CaptureWait {
  public:
    static constexpr interaction::Seconds kPatience{10};
    static constexpr interaction::Seconds kSteady{1}; ///< without a change of the query
    /// More of one frame does not count: some slow frames are no endless motion.
    static constexpr interaction::Seconds kOfFrame{0.5};

    void ask();
    int wanted() const { return wanted_; }
    /// What the user is told while pictures are wanted; empty: none is.
    std::string note() const;

    /// Called in each frame in which a capture is wanted.
    /// @return true: take one capture now; it then counts as taken
    bool take(const CaptureView& now);

  private:
    int wanted_ = 0;
    std::optional<CaptureView> before_;   ///< the last frame in which a capture was wanted
    interaction::Seconds asked_since_{0}; ///< when the newest query was first asked
    interaction::Seconds waited_{0};      ///< for an end of motion
};

} // namespace isochron::app
