// Finds the limit by the machine's memory, control groups and resource limits.
#include "index/system/memory_limit.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

/// The lowest limit of a control group and the groups around it; a file that is missing, or says
/// `max`, sets no limit.
std::uint64_t group_limit(const fs::path& root, fs::path group, const char* file,
                          std::uint64_t limit) {
    for (;; group = group.parent_path()) {
        std::uint64_t bytes = 0;
        if (std::ifstream(root / group.relative_path() / file) >> bytes)
            limit = std::min(limit, bytes);
        if (!group.has_relative_path())
            return limit;
    }
}

} // namespace

std::uint64_t memory_limit(const fs::path& root) {
    std::uint64_t limit = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                          static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    struct rlimit space {};
    if (::getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY)
        limit = std::min<std::uint64_t>(limit, space.rlim_cur);
    // Lines like `0::/user.slice` (version 2) or `9:memory:/user.slice` (version 1).
    std::ifstream groups(root / "proc/self/cgroup");
    for (std::string line; std::getline(groups, line);) {
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos)
            continue;
        const std::string controllers = line.substr(first + 1, second - first - 1);
        const fs::path group = line.substr(second + 1);
        if (controllers.empty())
            for (const char* file : {"memory.max", "memory.high"})
                limit = group_limit(root / "sys/fs/cgroup", group, file, limit);
        else if (controllers == "memory")
            limit =
                group_limit(root / "sys/fs/cgroup/memory", group, "memory.limit_in_bytes", limit);
    }
    return limit;
}

} // namespace isochron::index
