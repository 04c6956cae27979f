// Warns when processes of a cluster's job compete for the processors of one machine.
#include "app/cluster/processor_shares.h"

#include <fmt/format.h>

#include <map>
#include <set>

namespace isochron::app {
namespace {

struct Machine {
    std::size_t processes = 0, threads = 0;
    std::set<int> processors;
};

} // namespace

std::vector<std::string> shared_processors(std::span<const ProcessorShare> shares) {
    std::map<std::string, Machine> machines;
    for (const ProcessorShare& share : shares)
        if (share.threads > 0) {
            Machine& machine = machines[share.host];
            machine.processes += 1;
            machine.threads += share.threads;
            machine.processors.insert(share.processors.begin(), share.processors.end());
        }
    std::vector<std::string> lines;
    for (const auto& [host, machine] : machines) {
        const std::size_t processors = machine.processors.size();
        if (machine.processes < 2 || machine.threads <= processors)
            continue;
        const std::string what =
            processors < machine.processes
                ? fmt::format("start no more than {} there", processors)
                : fmt::format("mpirun --bind-to none -x LP_NUM_THREADS={} gives each its own",
                              processors / machine.processes);
        lines.push_back(fmt::format("{} processes draw in software on {}, {} threads on {} "
                                    "processor{}: {}",
                                    machine.processes, host, machine.threads, processors,
                                    processors == 1 ? "" : "s", what));
    }
    return lines;
}

} // namespace isochron::app
