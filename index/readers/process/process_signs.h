// What the system tells about another process, to see whether it still makes progress.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include <sys/types.h>

namespace isochron::index {

struct ProcessSigns {
    std::uint64_t read = 0;    ///< [bytes] by read calls
    std::uint64_t touched = 0; ///< page faults: pages that it has touched for the first time
    std::chrono::nanoseconds worked{0};        ///< processor time of all its threads
    bool waits_for_disk = false, runs = false; ///< `runs`: has a processor, or waits for one
};

/// Processor time of all threads of a process so far; 0 where it has ended.
std::chrono::nanoseconds processor_time_of(pid_t process);

/// None if the system does not tell.
std::optional<ProcessSigns> signs_of(pid_t process);

} // namespace isochron::index
