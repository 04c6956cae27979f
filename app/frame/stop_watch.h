// Measures the times of consecutive stages.
#pragma once

#include "app/frame/milliseconds.h"

#include <time.h>

#include <chrono>
#include <utility>

namespace isochron::app {

/// Time that all threads of the program have computed.
inline Milliseconds processor_time() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

class StopWatch {
  public:
    /// What `lap` would return; this lap goes on.
    Milliseconds time() const { return Clock::now() - last_; }
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
