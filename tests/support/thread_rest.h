// Tells whether another thread of this process has nothing left to do.
#pragma once

#include <fstream>
#include <string>

#include <sys/types.h>

namespace isochron::test_support {

/// Whether a thread sleeps. If nothing but work can wake the thread, and it holds no lock that
/// others wait for, the thread has found no work. @param thread the number that `gettid` gave it
inline bool sleeps(pid_t thread) {
    std::ifstream file("/proc/self/task/" + std::to_string(thread) + "/stat");
    std::string stat;
    std::getline(file, stat, '\0'); // an iterator would throw where the thread ends meanwhile
    const std::size_t name_end = stat.rfind(')'); // number (name) state ...
    return name_end != std::string::npos && stat.substr(name_end, 3) == ") S";
}

} // namespace isochron::test_support
