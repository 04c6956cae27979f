// The memory limit, by control groups of both versions.
#include "index/system/memory_limit.h"
#include "tests/support/test_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace isochron::index {
namespace {

class MemoryLimit : public testing::Test {
  protected:
    void write(const std::string& name, const std::string& text) {
        std::filesystem::create_directories((folder_.path() / name).parent_path());
        folder_.write(name, text);
    }
    std::uint64_t limit() const { return memory_limit(folder_.path()); }

    test_support::TestFolder folder_;
};

TEST_F(MemoryLimit, OfNoGroupIsThatOfTheMachine) {
    EXPECT_GT(limit(), std::uint64_t{1} << 26);
    EXPECT_EQ(limit(), memory_limit(folder_.path() / "nothing"));
}

TEST_F(MemoryLimit, IsTheLowestOfTheGroupAndThoseAroundIt) {
    write("proc/self/cgroup", "0::/user.slice/one\n");
    write("sys/fs/cgroup/user.slice/one/memory.max", "max\n");
    write("sys/fs/cgroup/user.slice/one/memory.high", "max\n");
    const std::uint64_t machine = limit();
    write("sys/fs/cgroup/user.slice/memory.max", "50000000\n");
    EXPECT_EQ(limit(), 50000000u);
    write("sys/fs/cgroup/user.slice/one/memory.high", "40000000\n");
    EXPECT_EQ(limit(), 40000000u);
    write("sys/fs/cgroup/memory.max", "30000000\n"); // as a container sees its own group
    EXPECT_EQ(limit(), 30000000u);
    EXPECT_GT(machine, 50000000u);
}

TEST_F(MemoryLimit, IsThatOfAGroupOfVersionOne) {
    write("proc/self/cgroup", "12:cpu,cpuacct:/\n9:memory:/user.slice\n");
    write("sys/fs/cgroup/memory/user.slice/memory.limit_in_bytes", "20000000\n");
    EXPECT_EQ(limit(), 20000000u);
}

} // namespace
} // namespace isochron::index
