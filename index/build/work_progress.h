// How far a build is as a whole.
#pragma once

#include "index/progress.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace isochron::index {

/// Turns the fraction of a phase that is done into that of all phases, of each of which it is known
/// about how long it takes.
class WorkProgress {
  public:
    /// @param out may be empty
    explicit WorkProgress(Progress out) : out_(std::move(out)) {}

    /// What is to come, in its order, in any unit; what has been done before stays in its place.
    void plan(std::vector<std::pair<std::string, double>> phases) { phases_ = std::move(phases); }

    /// @param fraction of the phase; one that was not planned for takes no time
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
