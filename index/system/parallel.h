// Independent pieces of work on all processors.
#pragma once

#include <cstddef>
#include <functional>

namespace isochron::index {

/// Threads to use where 0 asks for as many as there are processors.
unsigned thread_count(unsigned asked);

/// Calls `work(item, worker)` once for every item below `count`; workers are numbered below
/// `threads`, and no two calls with one worker overlap. The calling thread is worker 0 and the only
/// one to call `progress` (may be empty) with the fraction done: at the start and after its items.
/// What any of them throws first stops the others after their current item, and is thrown.
void parallel_for(std::size_t count, unsigned threads,
                  const std::function<void(std::size_t item, unsigned worker)>& work,
                  const std::function<void(double)>& progress);

} // namespace isochron::index
