// Building by several processes of an MPI job.
#include "tests/support/child_process.h"
#include "tests/support/paths.h"
#include "tests/support/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

namespace isochron::app {
namespace {

using testing::ElementsAreArray;
using testing::HasSubstr;

/// A folder with two series, of bytes and of floats.
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
        std::vector<std::string> given{type.substr(0, 1) + "?.raw",
                                       "--dims",
                                       std::to_string(kX),
                                       std::to_string(kY),
                                       std::to_string(kZ),
                                       "--type",
                                       type};
        given.insert(given.end(), more.begin(), more.end());
        return build_of(processes, given, out);
    }
    ChildResult build_of(int processes, const std::vector<std::string>& given,
                         const std::string& out) {
        std::vector<std::string> arguments{test_support::binary_root() + "/isochron"};
        if (processes > 0)
            arguments = of_processes(static_cast<std::size_t>(processes), arguments);
        arguments.insert(arguments.end(), {"build", "-o", out});
        arguments.insert(arguments.end(), given.begin(), given.end());
        return run_child("/usr/bin/env", arguments, folder.path());
    }

    TestFolder folder;
};

TEST_F(MpiBuild, GivesTheSameBytesOfSeveralArrays) {
    for (int t = 0; t < kSteps; ++t) {
        const std::string bytes = folder.read("u" + std::to_string(t) + ".raw");
        std::string pairs;
        for (const char value : bytes)
            (pairs += value) += static_cast<char>(255 - static_cast<unsigned char>(value));
        folder.write("v" + std::to_string(t) + ".nrrd",
                     "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 2 70 50 45\n"
                     "kinds: vector domain domain domain\nencoding: raw\n\n" +
                         pairs);
    }
    const std::vector<std::string> given{"v?.nrrd",  "--array", "values.0",        "--array",
                                         "values.1", "--array", "values.magnitude"};
    ASSERT_EQ(build_of(0, given, "alone").status, 0);
    for (const int processes : {2, 3}) {
        const ChildResult result = build_of(processes, given, "job");
        ASSERT_EQ(result.status, 0) << result.err;
        EXPECT_EQ(folder.read("job"), folder.read("alone")) << processes;
    }
}

TEST_F(MpiBuild, GivesTheSameBytesWhateverTheNumberOfProcesses) {
    for (const std::string type : {"u8", "f32"}) {
        ASSERT_EQ(build(0, type, "alone").status, 0);
        // More than there are steps or chunks, too.
        const std::vector<int> jobs = type == "u8" ? std::vector{1, 2, 3, 7} : std::vector{3};
        for (const int processes : jobs) {
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

TEST_F(MpiBuild, AppendsInPlace) {
    for (const std::string type : {"u8", "f32"}) {
        const std::string letter = type.substr(0, 1);
        for (const int step : {3, 4})
            std::filesystem::rename(folder.path() / (letter + std::to_string(step) + ".raw"),
                                    folder.path() / ("later" + std::to_string(step)));
        ASSERT_EQ(build(0, type, "alone").status, 0);
        std::filesystem::copy_file(folder.path() / "alone", folder.path() / "job");
        for (const int step : {3, 4})
            std::filesystem::rename(folder.path() / ("later" + std::to_string(step)),
                                    folder.path() / (letter + std::to_string(step) + ".raw"));
        ASSERT_EQ(build(0, type, "alone", {"--append"}).status, 0);
        const ChildResult result = build(3, type, "job", {"--append"});
        ASSERT_EQ(result.status, 0) << result.err;
        EXPECT_EQ(folder.read("job"), folder.read("alone"));
        std::filesystem::remove(folder.path() / "job");
        std::filesystem::remove(folder.path() / "alone");
    }
}

TEST_F(MpiBuild, ReadsInAReaderOfEveryProcess) {
    const auto vti = std::filesystem::path(test_support::test_data()) / "vti" / "raw_zlib64.vti";
    for (const char* name : {"s0.vti", "s1.vti", "s2.vti"})
        std::filesystem::copy_file(vti, folder.path() / name);
    const auto build_vti = [&](std::vector<std::string> arguments, const std::string& out) {
        arguments.insert(arguments.end(), {test_support::binary_root() + "/isochron", "build",
                                           "s?.vti", "--time-step", "1", "-o", out});
        return run_child("/usr/bin/env", arguments, folder.path());
    };
    ASSERT_EQ(build_vti({}, "alone").status, 0);
    const ChildResult job = build_vti(of_processes(2, {}), "job");
    ASSERT_EQ(job.status, 0) << job.err;
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

/// A job of two processes that takes long, the second of which gets a signal in its midst.
ChildResult struck_job(TestFolder& folder, const std::string& signal) {
    const std::string build = test_support::binary_root() +
                              "/isochron build n?.raw --dims 96 96 96 --type u8 --lattice 256 "
                              "--timeout 5 -o job";
    const std::string when_under_way =
        "(while kill -0 $$ && ! ls .job.*.tmp; do sleep 0.02; done; kill -" + signal +
        " $$) >/dev/null 2>&1 & exec " + build;
    for (int step = 0; step < 6; ++step) {
        std::string noise(std::size_t{96} * 96 * 96, '\0');
        std::mt19937 random(static_cast<unsigned>(step));
        std::ranges::generate(noise, [&] { return static_cast<char>(random()); });
        folder.write("n" + std::to_string(step) + ".raw", noise);
    }
    return run_child("/usr/bin/env",
                     // One command for both: mpirun 5.0.7 crashes if there are several.
                     of_processes(2, {"/bin/sh", "-c",
                                      "if [ $OMPI_COMM_WORLD_RANK = 0 ]; then exec " + build +
                                          "; fi; " + when_under_way}),
                     folder.path());
}

std::vector<std::string> lines_of_ours(const ChildResult& result) {
    std::vector<std::string> lines;
    std::istringstream all(result.err);
    for (std::string line; std::getline(all, line);) {
        line.erase(0, line.find_first_not_of('\0')); // mpirun 5 ends what it says with a 0
        if (line.starts_with("isochron: "))
            lines.push_back(line);
    }
    return lines;
}

TEST_F(MpiBuild, AStoppedProcessEndsTheJobWithItsNameAndLeavesNothing) {
    const ChildResult result = struck_job(folder, "STOP");
    EXPECT_NE(result.status, 0);
    const auto lines = lines_of_ours(result);
    ASSERT_EQ(lines.size(), 1u) << result.err;
    EXPECT_THAT(lines.front(), testing::StartsWith("isochron: process 1 on "));
    EXPECT_THAT(lines.front(), HasSubstr("no sign of life for "));
    for (const std::string& name : folder.names())
        EXPECT_EQ(name.find("job"), std::string::npos) << name;
}

TEST_F(MpiBuild, AKilledProcessEndsTheJobInOneLineAndLeavesNothing) {
    const ChildResult result = struck_job(folder, "KILL");
    EXPECT_NE(result.status, 0);
    const auto lines = lines_of_ours(result);
    ASSERT_EQ(lines.size(), 1u) << result.err;
    // Whoever is quicker says so: mpirun, or the one who waits.
    EXPECT_THAT(lines.front(), testing::AnyOf(HasSubstr("another process of the job has ended"),
                                              HasSubstr("process 1 on ")));
    for (const std::string& name : folder.names())
        EXPECT_EQ(name.find("job"), std::string::npos) << name;
}

} // namespace
} // namespace isochron::app
