// Limits the rate of a loop.
#pragma once

#include <algorithm>
#include <chrono>
#include <thread>

namespace isochron::app {

/// Sleeps between frames when no display paces them, so that an idle window does not keep a
/// processor busy.
class Pacer {
  public:
    explicit Pacer(double frames_per_second)
        : interval_(std::chrono::duration_cast<Clock::duration>(
              std::chrono::duration<double>(1.0 / frames_per_second))) {}
    void wait() {
        next_ = std::max(next_ + interval_, Clock::now());
        std::this_thread::sleep_until(next_);
    }

  private:
    using Clock = std::chrono::steady_clock;
    Clock::duration interval_;
    Clock::time_point next_ = Clock::now();
};

} // namespace isochron::app
