// How long it takes until what was asked for is shown.
#pragma once

#include "app/frame/frame_report.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace isochron::bench {

/// Takes the frames of a session in their order. What a newer query replaces counts as shown when
/// the newer one is: that is when the user sees the answer.
class AskedShown {
  public:
    /// @param done session time at which the frame was presented [s]
    void add(const app::FrameReport& frame, double done) {
        const index::SurfacesQuery now = frame.asked.of_cells();
        if (!last_ || now != *last_) {
            if (last_) // what the first frame asks for was there before
                asked_.push_back({now, frame.time.count()});
            last_ = now;
        }
        if (!frame.shown)
            return;
        const index::SurfacesQuery shown = frame.shown->of_cells();
        for (std::size_t i = asked_.size(); i-- > answered_;) {
            if (asked_[i].query != shown)
                continue;
            for (; answered_ <= i; ++answered_)
                milliseconds_.push_back(1e3 * (done - asked_[answered_].time));
            break;
        }
    }
    /// Adds a frame of a motion that asks for no other cells: what the eyes see follows the input
    /// of the frame itself.
    void add_moved(const app::FrameReport& frame, double done) {
        if (frame.redrawn)
            milliseconds_.push_back(1e3 * (done - frame.time.count()));
    }
    const std::vector<double>& milliseconds() const { return milliseconds_; }
    std::size_t unanswered() const { return asked_.size() - answered_; }
    /// Empty if nothing was asked for and shown.
    std::optional<double> percentile(double percent) const;

  private:
    struct Asked {
        index::SurfacesQuery query;
        double time;
    };
    std::optional<index::SurfacesQuery> last_;
    std::vector<Asked> asked_;
    std::size_t answered_ = 0; ///< number of answered queries among those asked
    std::vector<double> milliseconds_;
};

} // namespace isochron::bench
