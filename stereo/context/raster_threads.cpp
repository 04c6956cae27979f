// Finds llvmpipe's threads by their names, and binds them.
#include "stereo/context/raster_threads.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sched.h>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>

namespace isochron::stereo {
namespace {

constexpr std::string_view kName = "llvmpipe-"; // and the thread's number

std::optional<unsigned> number_in(std::string_view text) {
    unsigned number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() ? std::optional(number) : std::nullopt;
}

/// Number of earlier processes of the job on this machine, by Open MPI; each process begins at
/// another processor.
std::size_t processes_before() {
    const char* rank = std::getenv("OMPI_COMM_WORLD_LOCAL_RANK");
    return rank ? number_in(rank).value_or(0) : 0;
}

std::vector<int> allowed_processors() {
    std::vector<int> processors;
    cpu_set_t allowed;
    if (sched_getaffinity(0, sizeof(allowed), &allowed) == 0)
        for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
            if (CPU_ISSET(cpu, &allowed))
                processors.push_back(cpu);
    return processors;
}

/// The number of threads that Mesa makes: none if there is only one processor.
std::size_t threads_on(std::size_t processors) {
    constexpr std::size_t kMost = 16;
    const char* wanted = std::getenv("LP_NUM_THREADS");
    const std::optional<unsigned> number = wanted ? number_in(wanted) : std::nullopt;
    return std::min(number ? *number : processors > 1 ? processors : 0, kMost);
}

/// @return number of threads found
std::size_t bind_threads(const std::vector<int>& processors, std::size_t first) {
    std::size_t found = 0;
    std::error_code ended; // a thread may end meanwhile
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task", ended)) {
        std::string name;
        std::ifstream comm(task.path() / "comm");
        std::getline(comm, name);
        if (!name.starts_with(kName))
            continue;
        const auto number = number_in(std::string_view(name).substr(kName.size()));
        const auto thread = number_in(task.path().filename().native());
        if (!number || !thread)
            continue;
        ++found;
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(processors[(first + *number) % processors.size()], &one);
        sched_setaffinity(static_cast<pid_t>(*thread), sizeof(one), &one);
    }
    return found;
}

} // namespace

RasterThreads raster_threads() {
    RasterThreads plan{allowed_processors(), 0};
    plan.threads = threads_on(plan.processors.size());
    return plan;
}

void spread_raster_threads() {
    const auto [processors, threads] = raster_threads();
    if (processors.empty())
        return;
    const std::size_t first = processes_before() * threads;
    constexpr int kTries = 20;
    for (int i = 0; i < kTries && bind_threads(processors, first) < threads; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

} // namespace isochron::stereo
