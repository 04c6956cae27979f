// Building by several processes of an MPI job.
#include "tests/support/child_process.h"
#include "tests/support/paths.h"
#include "tests/support/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace isochron::app {
namespace {

using testing::ElementsAreArray;
using testing::HasSubstr;

/// A folder with two series, of bytes (bricks, cells and deltas) and of floats (bricks).
class MpiBuild : public testing::Test {
  protected:
    static constexpr int kX = 70, kY = 50, kZ = 45, kSteps = 5;

    MpiBuild() {
        for (int t = 0; t < kSteps; ++t) {
            std::string bytes;
            std::vector<float> floats;
            for (int z = 0; z < kZ; ++z)
                for (int y = 0; y < kY; ++y)
                    for (int x = 0; x < kX; ++x) {
                        const double d = std::hypot(x - 30.0 - t, y - 25.0, z - 20.0);
                        floats.push_back(static_cast<float>(255 * std::exp(-d * d / 200)));
                        bytes.push_back(static_cast<char>(std::lround(floats.back())));
                    }
            folder.write("u" + std::to_string(t) + ".raw", bytes);
            folder.write("f" + std::to_string(t) + ".raw",
                         {reinterpret_cast<const char*>(floats.data()), floats.size() * 4});
        }
    }

    ChildResult build(int processes, const std::string& type, const std::string& out,
                      const std::vector<std::string>& more = {}) {
        // The MPI library itself leaks.
        std::vector<std::string> arguments{"ASAN_OPTIONS=detect_leaks=0",
                                           "mpirun",
                                           "--allow-run-as-root",
                                           "--oversubscribe",
                                           "-n",
                                           std::to_string(processes),
                                           test_support::binary_root() + "/isochron"};
        if (processes == 0)
            arguments = {test_support::binary_root() + "/isochron"};
        arguments.insert(arguments.end(),
                         {"build", type.substr(0, 1) + "?.raw", "--dims", std::to_string(kX),
                          std::to_string(kY), std::to_string(kZ), "--type", type, "-o", out});
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_child("/usr/bin/env", arguments, folder.path());
    }

    TestFolder folder;
};

TEST_F(MpiBuild, GivesTheSameBytesWhateverTheNumberOfProcesses) {
    for (const std::string type : {"u8", "f32"}) {
        ASSERT_EQ(build(0, type, "alone").status, 0);
        // More than there are steps or chunks, too.
        for (const int processes : {1, 2, 3, 7}) {
            const ChildResult result = build(processes, type, "job");
            ASSERT_EQ(result.status, 0) << result.err;
            EXPECT_EQ(folder.read("job"), folder.read("alone")) << processes;
            EXPECT_THAT(result.out, HasSubstr("job: 70 x 50 x 45 vertices, 5 steps"));
            EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 2) << "said once";
        }
    }
    ASSERT_EQ(build(0, "u8", "alone", {"--refer"}).status, 0);
    ASSERT_EQ(build(3, "u8", "job", {"--refer"}).status, 0);
    EXPECT_EQ(folder.read("job"), folder.read("alone"));
}

TEST_F(MpiBuild, AFailureOfOneProcessEndsTheJobInOneLineAndLeavesNothing) {
    // Read by the last process only.
    std::filesystem::resize_file(folder.path() / "u4.raw", 100);
    const auto before = folder.names();
    const ChildResult result = build(3, "u8", "job");
    EXPECT_NE(result.status, 0);
    std::size_t lines = 0;
    for (std::size_t at = 0; (at = result.err.find("isochron: ", at)) != std::string::npos; ++at)
        ++lines;
    EXPECT_EQ(lines, 1u) << result.err;
    EXPECT_THAT(result.err, HasSubstr("u4.raw"));
    EXPECT_THAT(folder.names(), ElementsAreArray(before));
}

} // namespace
} // namespace isochron::app
