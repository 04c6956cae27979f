// Makes an index in the background, while its first steps are shown.
#pragma once

#include "app/command_line/progress_bar.h"
#include "app/indexing/build_arguments.h"

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace isochron::app {

/// Runs `kept_index` on a thread of its own. Thread-safe.
class Indexing {
  public:
    struct State {
        std::optional<std::filesystem::path> index; ///< empty: there are no steps to show yet
        std::size_t steps = 0;                      ///< that it has
        std::size_t of = 0;                         ///< 0: the files are not open yet
        std::string phase;
        double fraction = 0; ///< of the whole series
        std::string failure; ///< empty: none
        bool done = false;   ///< it is complete, or it has failed
        /// `indexing: 3 of 8 steps, 41 %`, or `opening`; empty when it is done.
        std::string line() const;
    };

    Indexing(BuildArguments arguments, std::filesystem::path folder);
    ~Indexing(); ///< ends the work; the steps that the index has stay
    Indexing(const Indexing&) = delete;
    Indexing& operator=(const Indexing&) = delete;

    State state() const;
    /// Waits until the files are open or opening has failed, at most this long.
    void wait_for_opening(std::chrono::milliseconds most) const;
    /// @throws what ended it, when it has failed
    void check() const;

  private:
    void run(const std::stop_token& stop);
    void set(const std::function<void(State&)>& change);

    const BuildArguments arguments_;
    const std::filesystem::path folder_;
    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;
    State state_;
    std::exception_ptr failed_;
    std::jthread worker_; ///< the last member: starts after, and is joined before, the others
};

} // namespace isochron::app
