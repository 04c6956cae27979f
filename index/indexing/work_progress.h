// Progress of a build as a whole.
#pragma once

#include "index/progress.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace isochron::index {

/// Turns the fraction done of a phase into the fraction done of all phases, from estimates of how
/// long each phase takes.
class WorkProgress {
  public:
    /// @param out may be empty
    explicit WorkProgress(Progress out) : out_(std::move(out)) {}

    /// Sets the phases in order, each with its estimated work, in any unit. May be called again
    /// with better estimates; the reported fraction never goes back.
    void plan(std::vector<std::pair<std::string, double>> phases) { phases_ = std::move(phases); }

    /// @param fraction of the phase; a phase that was not planned does not change the whole
    void report(std::string_view phase, double fraction) {
        double before = 0, all = 0, now = -1;
        for (const auto& [name, work] : phases_) {
            if (name == phase)
                now = before + work * std::clamp(fraction, 0.0, 1.0);
            before = all += work;
        }
        if (now >= 0 && all > 0)
            done_ = std::max(done_, now / all);
        if (out_)
            out_(phase, done_);
    }

  private:
    Progress out_;
    std::vector<std::pair<std::string, double>> phases_;
    double done_ = 0; ///< never goes back
};

} // namespace isochron::index
