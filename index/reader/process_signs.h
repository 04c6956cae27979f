// What the system tells of another process: whether it still gets anywhere.
#pragma once

#include <cstdint>
#include <optional>

#include <sys/types.h>

namespace isochron::index {

struct ProcessSigns {
    std::uint64_t read = 0;    ///< [bytes] by calls that read
    std::uint64_t touched = 0; ///< pages that it has met for the first time, in memory or on disk
    bool waits_for_disk = false;
};

/// None where the system does not say.
std::optional<ProcessSigns> signs_of(pid_t process);

} // namespace isochron::index
