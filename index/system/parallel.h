// Runs independent pieces of work on all processors.
#pragma once

#include <cstddef>
#include <functional>

namespace isochron::index {

/// The number of threads to use; `asked` 0 means one for each processor.
unsigned thread_count(unsigned asked);

/// Calls `work(item, worker)` once for every item below `count`. Workers are numbered from 0 to
/// `threads` - 1, and two calls with the same worker never overlap. The calling thread is worker 0.
/// Only it calls `progress` (may be empty) with the fraction done, at the start and after each of
/// its items. The first exception of any worker stops the others after their current item, and is
/// thrown.
void parallel_for(std::size_t count, unsigned threads,
                  const std::function<void(std::size_t item, unsigned worker)>& work,
                  const std::function<void(double)>& progress);

} // namespace isochron::index
