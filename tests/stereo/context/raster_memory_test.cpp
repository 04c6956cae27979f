// What software GL has freed stays with the process.
#include "stereo/context/gl_context.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

namespace isochron::stereo {
namespace {

/// Bytes of this process in memory.
std::size_t resident_bytes() {
    std::size_t all = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> all >> resident;
    return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

TEST(RasterMemory, IsKeptWhenItIsFreed) {
    const auto context = make_context(ContextKind::egl, {.size = {16, 16}});
    if (context->description().find("llvmpipe") == std::string::npos)
        GTEST_SKIP() << "another driver draws: " << context->description();
    constexpr std::size_t kBlock = 4 << 20, kBlocks = 12, kAll = kBlock * kBlocks;
    std::vector<std::unique_ptr<std::byte[]>> blocks;
    for (std::size_t i = 0; i < kBlocks; ++i)
        blocks.push_back(std::make_unique<std::byte[]>(kBlock)); // zeroed, so that it is there
    const std::size_t taken = resident_bytes();
    blocks.clear();
    const std::size_t left = resident_bytes();
    EXPECT_GT(left + kAll / 4, taken) << "given back " << (taken - left) << " of " << kAll;
}

} // namespace
} // namespace isochron::stereo
