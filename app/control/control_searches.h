// The searches that clients of the control socket ask for, on a thread of their own, one after another.
#pragma once

#include "app/control/control_answers.h"

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

namespace isochron::app {

/// A search, for whom it is, and what it is asked of.
struct ControlSearch {
    std::uint64_t client = 0;
    std::string id; ///< id of the request, as JSON
    ControlRequest request;
    std::shared_ptr<const index::IndexFile> file;
    std::shared_ptr<const ExplorerState> shown;
};

class ControlSearches {
  public:
    static constexpr std::size_t kMostWaiting = 8;

    /// @param done called on the searches' thread when there is an answer to be taken
    explicit ControlSearches(std::function<void()> done);
    ~ControlSearches(); ///< stops the search that goes on

    /// @return false: too many wait
    bool add(ControlSearch search);
    struct Found {
        std::uint64_t client = 0;
        ControlAnswer answer;
    };
    /// The answers since the last call.
    std::vector<Found> take();

  private:
    void run(const std::stop_token& stop);

    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::deque<ControlSearch> waiting_;
    std::vector<Found> found_;
    const std::function<void()> done_;
    std::jthread thread_; ///< last: begins when all else is there, and ends before it goes
};

} // namespace isochron::app
