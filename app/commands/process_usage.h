// What this process has taken of the machine so far.
#pragma once

#include <cstdint>

namespace isochron::app {

struct ProcessUsage {
    std::uint64_t resident_bytes = 0; ///< of its memory now, mapped files included
    std::uint64_t read_bytes = 0;     ///< from storage, not from the page cache
};

/// From /proc; 0 where the system does not say.
ProcessUsage process_usage();

} // namespace isochron::app
