// Memory and storage reads of this process.
#pragma once

#include <cstdint>

namespace isochron::app {

struct ProcessUsage {
    std::uint64_t resident_bytes = 0; ///< resident now, mapped files included
    std::uint64_t read_bytes = 0;     ///< read from storage so far, without the page cache
};

/// Read from /proc; 0 if the system does not tell.
ProcessUsage process_usage();

} // namespace isochron::app
