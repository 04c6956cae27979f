// Measures the times of consecutive stages.
#pragma once

#include "app/frame/milliseconds.h"

#include <chrono>
#include <utility>

namespace isochron::app {

class StopWatch {
  public:
    /// Time since the last lap, or since the start.
    Milliseconds lap() {
        const auto now = Clock::now();
        return now - std::exchange(last_, now);
    }

  private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point last_ = Clock::now();
};

} // namespace isochron::app
