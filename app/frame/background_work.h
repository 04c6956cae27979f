// Work that may wait for a disk, on a thread of its own, so that no frame waits for it.
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
    ~BackgroundWork(); ///< does what is still waiting

    /// Tasks are done one after another, in order. Never waits.
    void post(Task task);

    /// Blocks until few tasks wait: for replays, which can draw faster than a disk writes.
    void wait_for_room();

    /// What tasks returned, or why they failed, since the last call.
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
    std::jthread worker_; ///< last: started when all else is ready, joined before it goes
};

} // namespace isochron::app
