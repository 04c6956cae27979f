// Each of software GL's threads has its own processor.
#include "stereo/context/gl_context.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sched.h>
#include <set>
#include <string>

namespace isochron::stereo {
namespace {

TEST(RasterThreads, HaveAProcessorEach) {
    cpu_set_t allowed;
    ASSERT_EQ(sched_getaffinity(0, sizeof(allowed), &allowed), 0);
    const auto processors = static_cast<std::size_t>(CPU_COUNT(&allowed));
    const auto context = make_context(ContextKind::egl, {.size = {16, 16}});
    const bool software = context->description().find("llvmpipe") != std::string::npos;
    std::size_t threads = 0;
    std::set<int> used;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
        std::string name;
        std::ifstream comm(task.path() / "comm");
        std::getline(comm, name);
        if (!name.starts_with("llvmpipe-"))
            continue;
        ++threads;
        cpu_set_t bound;
        ASSERT_EQ(sched_getaffinity(std::stoi(task.path().filename()), sizeof(bound), &bound), 0);
        EXPECT_EQ(CPU_COUNT(&bound), 1) << name;
        for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
            if (CPU_ISSET(cpu, &bound))
                used.insert(cpu);
    }
    if (software && !std::getenv("LP_NUM_THREADS") && processors > 1) {
        EXPECT_GT(threads, 1u);
    }
    EXPECT_EQ(used.size(), std::min(threads, processors));
}

} // namespace
} // namespace isochron::stereo
