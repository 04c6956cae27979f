// Finds the limit by the machine's memory, control groups and resource limits.
#include "index/system/memory_limit.h"

#include <fmt/format.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

/// The lowest limit of a control group and the groups around it; a file that is missing, or says
/// `max`, sets no limit.
std::uint64_t group_limit(const std::string& root, std::string group, const char* file,
                          std::uint64_t limit) {
    while (true) {
        std::uint64_t bytes = 0;
        if (std::ifstream(root + group + '/' + file) >> bytes)
            limit = std::min(limit, bytes);
        const std::size_t slash = group.rfind('/');
        if (slash == std::string::npos)
            return limit;
        group.resize(slash);
    }
}

constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();

/// The machine's memory [bytes].
std::uint64_t whole_memory() {
    return static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
           static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

/// The limit of the address space [bytes] (`ulimit -v`), or kNone.
std::uint64_t limit_of_addresses() {
    struct rlimit space{};
    const bool limited = ::getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY;
    return limited ? space.rlim_cur : kNone;
}

/// Address space and memory that this process uses [bytes]; 0 where the kernel does not say.
struct Used {
    std::uint64_t addresses = 0, memory = 0;
};

Used used(const fs::path& root) {
    const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    std::uint64_t all = 0, resident = 0;
    if (!(std::ifstream(root / "proc/self/statm") >> all >> resident))
        return {};
    return {all * page, std::min(all, resident) * page};
}

/// Address space of this process that holds no memory [bytes]: libraries, stacks, what may be needed.
rlim_t only_addresses(const fs::path& root) {
    const Used now = used(root);
    return now.addresses - now.memory;
}

} // namespace

std::uint64_t memory_limit(const fs::path& root) {
    std::uint64_t limit = whole_memory();
    if (const std::uint64_t addresses = limit_of_addresses(); addresses != kNone)
        limit = std::min(limit, addresses - std::min(addresses / 2, only_addresses(root)));
    // Lines like `0::/user.slice` (version 2) or `9:memory:/user.slice` (version 1).
    std::ifstream groups(root / "proc/self/cgroup");
    for (std::string line; std::getline(groups, line);) {
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos)
            continue;
        const std::string controllers = line.substr(first + 1, second - first - 1);
        const std::string group = line.substr(second + 1);
        if (controllers.empty())
            for (const char* file : {"memory.max", "memory.high"})
                limit = group_limit(root.string() + "/sys/fs/cgroup", group, file, limit);
        else if (controllers == "memory")
            limit = group_limit(root.string() + "/sys/fs/cgroup/memory", group,
                                "memory.limit_in_bytes", limit);
    }
    return limit;
}

std::uint64_t addresses_left() {
    const std::uint64_t limit = limit_of_addresses();
    return limit == kNone ? kNone : limit - std::min(limit, used("/").addresses);
}

std::string shortage_of_memory() {
    const std::uint64_t all = whole_memory(), addresses = limit_of_addresses(),
                        limit = memory_limit();
    if (addresses < all)
        return fmt::format("there is not enough memory: the program may use {} MiB of address "
                           "space (ulimit -v)",
                           addresses >> 20);
    if (limit < all)
        return fmt::format("there is not enough memory: the program may use {} MiB", limit >> 20);
    return "there is not enough memory";
}

} // namespace isochron::index
