// A process with too little memory for what it shows ends in one line, wherever the memory ends.
#include "tests/app/commands/command_line.h"

namespace isochron::app {
namespace {

class MemoryShortage : public CommandLine {
  protected:
    /// @param kibibytes of address space that the command may use
    ChildResult limited(unsigned kibibytes, const std::string& command) {
        return run_child("/bin/sh",
                         {"-c", fmt::format("ulimit -v {}; exec {}/isochron {}", kibibytes,
                                            test_support::binary_root(), command)},
                         folder.path());
    }
};

TEST_F(MemoryShortage, IsOneLineThoughADriverOfOpenGLCrashes) {
    ASSERT_EQ(isochron(build_of("t*.raw")).status, 0);
    int failed = 0, named = 0; // runs that failed, and those that named the limit
    // The driver takes some hundred MiB of addresses, in many pieces.
    for (unsigned kibibytes = 200'000; kibibytes <= 1'000'000; kibibytes += 50'000) {
        const ChildResult result =
            limited(kibibytes, "movie a.isochron --isovalue 0.1 --size 320 240 --force -o frames");
        if (result.status == 0)
            continue;
        ++failed;
        ASSERT_EQ(result.status, 1) << kibibytes << '\n' << result.err;
        const std::size_t line = result.err.rfind("isochron: ");
        ASSERT_NE(line, std::string::npos) << kibibytes << '\n' << result.err;
        ASSERT_EQ(result.err.find('\n', line), result.err.size() - 1) << result.err;
        named += result.err.ends_with(
            fmt::format("there is not enough memory: the program may use {} MiB of address space "
                        "(ulimit -v)\n",
                        kibibytes / 1024));
    }
    EXPECT_GT(failed, 3);
    EXPECT_GT(named, 2);
}

} // namespace
} // namespace isochron::app
