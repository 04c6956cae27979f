// Reads steps of many files in parallel.
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

/// The stored values of one array in a step.
using StepBytes = std::vector<std::byte>;

/// Reads whole steps of one array or several on a few threads, each with its own series, and gives
/// them in order. Memory holds one step more than there are threads.
class ParallelSteps {
  public:
    /// Number of threads worth using for these steps; 0 if only one thread can read the series,
    /// there is only one step, or the steps would take too much memory.
    static unsigned readers_for(std::span<VolumeSeries* const> arrays, std::size_t steps,
                                unsigned threads);

    /// @param arrays must outlive this @param readers from `readers_for`, not 0
    ParallelSteps(std::span<VolumeSeries* const> arrays, std::size_t begin, std::size_t end,
                  unsigned readers);
    ~ParallelSteps();
    ParallelSteps(const ParallelSteps&) = delete;
    ParallelSteps& operator=(const ParallelSteps&) = delete;

    /// The values of each array in the next step, valid until the next call. Waits until they have
    /// been read. @throws the exception of reading the step
    std::span<const StepBytes> next();

  private:
    using Arrays = std::vector<std::unique_ptr<VolumeSeries>>;
    struct Step {
        std::vector<StepBytes> values; ///< by array
        std::exception_ptr failure;
        bool there = false;
    };

    void run(const std::stop_token& stop, const Arrays& arrays);

    const std::size_t begin_, end_;
    std::mutex mutex_; ///< for the members below
    std::condition_variable_any changed_;
    std::vector<Step>
        steps_;             ///< step s is at the index (s - `begin_`) modulo the number of elements
    std::size_t taken_ = 0; ///< number of steps that readers have begun
    std::size_t given_ = 0; ///< number of steps that `next` has given
    std::vector<Arrays> arrays_;        ///< by reader
    std::vector<std::jthread> readers_; ///< last: they end before what they use
};

} // namespace isochron::index
