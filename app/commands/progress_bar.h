// How far long work is, on the terminal.
#pragma once

#include "index/progress.h"

#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>

namespace isochron::app {

/// On a terminal one bar per phase with the remaining time, redrawn in place; elsewhere (a log) one
/// line per phase.
///
///     ProgressBar bar;
///     index::build(..., bar.progress());
class ProgressBar {
  public:
    /// @param bytes that every phase goes through, to show a rate; 0 shows none
    explicit ProgressBar(std::FILE* out = stderr, double bytes = 0);
    ~ProgressBar(); ///< ends the line of the last phase
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// @param fraction of the phase that is done, in [0, 1]
    void show(std::string_view phase, double fraction);

    /// A callback that shows on this bar; the bar must outlive it.
    index::Progress progress();

  private:
    std::FILE* out_;
    bool terminal_;
    double bytes_;
    std::string phase_;
    std::chrono::steady_clock::time_point phase_start_;
    int percent_ = -1; ///< what is on the screen
};

} // namespace isochron::app
