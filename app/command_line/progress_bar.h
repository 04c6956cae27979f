// Shows the progress of long work on the terminal.
#pragma once

#include "index/progress.h"

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace isochron::app {

/// On a terminal: one bar per phase, or one for all phases, with the remaining time, redrawn in
/// place. Elsewhere (a log): one line per phase. With `--quiet`: nothing.
///
///     ProgressBar bar;
///     index::build(..., bar.progress());
class ProgressBar {
  public:
    /// Whether fractions are of one phase or of all phases together.
    enum class Of : std::uint8_t { phase, all };

    /// @param bytes that each phase (or all together) processes, for the rate; 0: shows no rate
    explicit ProgressBar(std::FILE* out = stderr, double bytes = 0, Of of = Of::phase);
    ~ProgressBar(); ///< ends the line of the last phase
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// @param fraction that is done, in [0, 1]
    void show(std::string_view phase, double fraction);

    /// A callback that shows on this bar; the bar must outlive it.
    index::Progress progress();

  private:
    std::FILE* out_;
    bool terminal_;
    double bytes_;
    Of of_;
    std::string phase_;
    std::chrono::steady_clock::time_point start_; ///< when the phase began, or the first one
    int percent_ = -1;                            ///< shown now
};

} // namespace isochron::app
