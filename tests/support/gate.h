// Holds threads of a test until the test lets them go.
#pragma once

#include <condition_variable>
#include <mutex>
#include <stop_token>

namespace isochron::test_support {

/// Closed at first. Whoever waits at it sleeps.
class Gate {
  public:
    void open() {
        {
            const std::scoped_lock lock(mutex_);
            is_open_ = true;
        }
        opened_.notify_all();
    }
    /// Waits until the gate is open, or until a stop is requested.
    void pass(const std::stop_token& stop = {}) {
        std::unique_lock lock(mutex_);
        opened_.wait(lock, stop, [this] { return is_open_; });
    }

  private:
    std::mutex mutex_;
    std::condition_variable_any opened_;
    bool is_open_ = false;
};

} // namespace isochron::test_support
