// The build and the machine that a benchmark measures.
#include "tests/bench/machine.h"

#include "commit.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <fstream>
#include <string>
#include <thread>

namespace isochron::bench {

namespace {

/// The kernel's name of the processor; with the model number if the name says little, as in virtual
/// machines.
std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    std::string name = "unknown", family, model, line;
    bool avx512 = false, avx2 = false;
    while (std::getline(file, line) && !line.empty()) {
        const std::size_t colon = line.find(':');
        if (colon == line.npos)
            continue;
        const std::string key = line.substr(0, line.find_last_not_of(" \t", colon - 1) + 1);
        const std::string value = colon + 2 < line.size() ? line.substr(colon + 2) : "";
        if (key == "model name")
            name = value;
        else if (key == "cpu family")
            family = value;
        else if (key == "model")
            model = value;
        else if (key == "flags") {
            avx2 = value.find(" avx2 ") != value.npos;
            avx512 = value.find(" avx512bw ") != value.npos;
        }
    }
    return fmt::format("{} (family {} model {}{})", name, family, model,
                       avx512 ? ", AVX-512"
                       : avx2 ? ", AVX2"
                              : "");
}

} // namespace

Header this_machine() {
    return {.commit = kCommit,
            .processor = processor(),
            .compiler = "g++ " __VERSION__,
            .date = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr))),
            .threads = std::thread::hardware_concurrency()};
}

} // namespace isochron::bench
