// Work that may wait for a disk, done on its own thread so that no frame waits.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace isochron::app {

class BackgroundWork {
  public:
    /// Returns what the user should know, or nothing; throws to report a failure.
    using Task = std::function<std::string()>;

    BackgroundWork();
    ~BackgroundWork(); ///< completes the tasks that still wait

    /// Sets the function that is called, on the worker's thread, when there is a message.
    void set_wake(std::function<void()> wake);

    /// Calls that function, for a task that has something to show before it ends.
    void wake();

    /// Adds a task and returns at once. Tasks run one after another, in order.
    void post(Task task);

    /// Blocks until only a few tasks wait: for replays, which can draw faster than a disk writes.
    void wait_for_room();

    /// What the tasks returned since the last call, or why they failed.
    std::vector<std::string> messages();

    /// Blocks until everything is done. @throws index::Error with the first failure
    void finish();

  private:
    void work(const std::stop_token& stop);

    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::deque<Task> tasks_;
    bool working_ = false;
    std::vector<std::string> messages_;
    std::string first_failure_;
    std::function<void()> wake_; ///< may be null
    std::jthread worker_;        ///< last member: starts after, and joins before, all the others
};

} // namespace isochron::app
