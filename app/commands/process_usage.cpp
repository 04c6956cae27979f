// Memory and storage reads of this process, from /proc.
#include "app/commands/process_usage.h"

#include <fstream>
#include <string>

namespace isochron::app {
namespace {

std::uint64_t number_after(const char* file, const std::string& name) {
    std::ifstream in(file);
    for (std::string word; in >> word;)
        if (word == name) {
            std::uint64_t number = 0;
            in >> number;
            return number;
        }
    return 0;
}

} // namespace

ProcessUsage process_usage() {
    return {number_after("/proc/self/status", "VmRSS:") * 1024,
            number_after("/proc/self/io", "read_bytes:")};
}

} // namespace isochron::app
