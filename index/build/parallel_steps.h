// Steps of many files, read side by side.
#pragma once

#include "index/volume/volume_series.h"

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <memory>
#include <mutex>
#include <span>
#include <stop_token>
#include <thread>
#include <vector>

namespace isochron::index {

/// Reads steps whole, each by one of a few threads that have a series of their own, and gives them
/// in order. Memory holds one step more than there are threads.
class ParallelSteps {
  public:
    /// So many threads are worth it for these steps: 0 where the series says that it is read by one
    /// alone, where there is one step only, or where memory would hold too much.
    static unsigned readers_for(const VolumeSeries& series, std::size_t steps, unsigned threads);

    /// @param series outlives this @param readers from `readers_for`, not 0
    ParallelSteps(const VolumeSeries& series, std::size_t begin, std::size_t end, unsigned readers);
    ~ParallelSteps();
    ParallelSteps(const ParallelSteps&) = delete;
    ParallelSteps& operator=(const ParallelSteps&) = delete;

    /// The values of the next step; they stay until the next call.
    /// @throws what reading it threw
    std::span<const std::byte> next();

  private:
    struct Step {
        std::vector<std::byte> values;
        std::exception_ptr failure;
        bool there = false;
    };

    void run(const std::stop_token& stop, VolumeSeries& series);

    const std::size_t begin_, end_;
    std::mutex mutex_; ///< of those below
    std::condition_variable_any changed_;
    std::vector<Step>
        steps_;             ///< step s lies in that of its number from `begin_`, modulo their count
    std::size_t taken_ = 0; ///< by readers, from `begin_`
    std::size_t given_ = 0; ///< by `next`, likewise
    std::vector<std::unique_ptr<VolumeSeries>> series_; ///< by reader
    std::vector<std::jthread> readers_;                 ///< last: they end before all that they use
};

} // namespace isochron::index
