// Makes an index in the background, while its first steps are shown.
#pragma once

#include "app/command_line/progress_bar.h"
#include "app/indexing/array_offers.h"
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
#include <vector>

namespace isochron::app {

/// Runs `kept_index` on a thread of its own. Thread-safe.
class Indexing {
  public:
    struct State {
        std::optional<std::filesystem::path> index; ///< empty: there are no steps to show yet
        std::size_t steps = 0;                      ///< steps that the index has
        std::size_t of = 0;                         ///< 0: the files are not open yet
        std::string phase;
        double fraction = 0;            ///< how much of the whole series is done
        std::string failure;            ///< empty: none
        bool done = false;              ///< it is complete, or it has failed
        std::vector<ArrayOffer> offers; ///< the user is to choose one; empty: nothing to choose
        std::string array;              ///< name of the chosen array; empty: there was no choice
        std::vector<ArrayOffer> others; ///< arrays that cannot be shown with it
        /// `indexing: 3 of 8 steps, 41 %`, or `opening`; empty when it is done.
        std::string line() const;
    };

    /// @param asks waits for `choose` where files have arrays of several shapes
    Indexing(BuildArguments arguments, std::filesystem::path folder, bool asks = false);
    ~Indexing(); ///< ends the work; the steps that the index has stay
    Indexing(const Indexing&) = delete;
    Indexing& operator=(const Indexing&) = delete;

    State state() const;
    /// Goes on with one of the arrays that are offered. @param offer its number
    void choose(std::size_t offer);
    /// Waits until the files are open, opening has failed, or arrays are offered, at most this long.
    void wait_for_opening(std::chrono::milliseconds most) const;
    /// @throws what ended it, when it has failed
    void check() const;

  private:
    void run(const std::stop_token& stop);
    void set(const std::function<void(State&)>& change);
    std::size_t chosen_of(const std::vector<ArrayOffer>& offers, const std::stop_token& stop);
    bool waits_for_choice() const;

    const BuildArguments arguments_;
    const std::filesystem::path folder_;
    mutable std::mutex mutex_;
    mutable std::condition_variable_any changed_;
    State state_;
    const bool asks_;
    std::optional<std::size_t> chosen_; ///< number of the chosen array among those offered
    std::exception_ptr failed_;
    std::jthread worker_; ///< the last member: starts after, and is joined before, the others
};

} // namespace isochron::app
