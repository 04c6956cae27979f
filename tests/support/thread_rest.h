// Tells whether another thread of this process has nothing left to do.
#pragma once

#include "index/readers/process/process_text.h"

#include <string>

#include <sys/types.h>

namespace isochron::test_support {

/// Whether a thread sleeps. If nothing but work can wake the thread, and it holds no lock that
/// others wait for, the thread has found no work. @param thread the number that `gettid` gave it
inline bool sleeps(pid_t thread) {
    const std::string stat =
        index::process_text("/proc/self/task/" + std::to_string(thread) + "/stat");
    const std::size_t name_end = stat.rfind(')'); // number (name) state ...
    return name_end != std::string::npos && stat.substr(name_end, 3) == ") S";
}

} // namespace isochron::test_support
