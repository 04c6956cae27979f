// No test assumes a pace: it counts, has a clock of its own, or waits for what happens. The few files
// that look at a real clock are listed here, each with the reason for which a slow machine does not
// fail there.
#include "tests/house/source_tree.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace isochron::house {
namespace {

namespace fs = std::filesystem;

const std::map<std::string, std::string> kReasons{
    {"tests/support/eventually.h", "the one limit of all that is waited for"},
    {"tests/support/child_process.cpp", "ends what hangs"},
    {"tests/support/played_headset/frame.cpp", "gives out frames as a headset does, however late"},
    {"tests/tools/tracker_sender.cpp", "a tool for people, no test"},
    {"tests/interaction/trackers/vrpn_test.cpp", "VRPN has a clock of its own; ends are awaited"},
    {"tests/stereo/openxr/headset_test.cpp", "a time lies between two looks at the clock"},
    {"tests/app/commands/explore_test.cpp",
     "--seconds ends what has shown a frame at least; a live "
     "replay takes no less than what was recorded"},
    {"tests/app/commands/explore_window_test.cpp", "--seconds ends what hangs"},
    {"tests/app/commands/explore_faults_test.cpp", "--seconds: one frame is enough"},
    {"tests/app/commands/output_ways.h", "--seconds: one frame is enough"},
    {"tests/app/commands/power_loss_test.cpp", "--seconds: one frame is enough"},
    {"tests/app/commands/headset_program_test.cpp", "--seconds: one frame is enough"},
    {"tests/app/commands/help_examples_test.cpp", "--seconds: one frame is enough"},
    {"tests/app/commands/links_test.cpp", "a server that hangs is ended by a signal, in time"},
    {"tests/app/commands/soak_test.cpp", "plays longer where ISOCHRON_SOAK_SECONDS says so"},
    {"tests/app/session/random_user_test.cpp", "plays longer where ISOCHRON_SOAK_SECONDS says so"},
    {"tests/app/commands/mpi_test.cpp", "--timeout: as long as for users, and who is stopped never "
                                        "answers"},
    {"tests/app/indexing/kept_index_test.cpp", "files of which the time of writing is hours ago"},
    {"tests/index/indexing/index_append_test.cpp",
     "a file of which the time of writing is an hour ago"},
    {"tests/app/control/control_harm_test.cpp",
     "asks how long a client may hang, and ends what does"},
    {"tests/app/command_line/end_in_time_test.cpp",
     "what ends a process after a time, which hangs"},
    {"tests/app/commands/cli_test.cpp", "files of which the time of writing is hours ago"},
    {"tests/app/commands/kills_test.cpp", "files of which the time of writing is minutes ago"},
    {"tests/fence/calls_test.cpp", "calls that tell the time are tried, whatever they tell"},
    {"tests/index/system/new_file_test.cpp", "a file of which the time of writing is minutes ago"},
    {"tests/index/readers/process/foreign_file_test.cpp",
     "the patience with a reader that is stopped: any "
     "runs out; a start that takes longer is repeated"},
    {"tests/index/conformance/conformance_test.cpp", "the patience with damaged files: who is too "
                                                     "slow counts as refused, which is allowed"},
};

/// Files of tests that wait for a time or ask for it. Benchmarks do nothing else.
std::set<std::string> files_with_clocks(const fs::path& root) {
    const std::regex clock(
        R"((steady|system|file|high_resolution)_clock|::clock::|clock_gettime|sleep_for|sleep_until|sleep\(|usleep|nanosleep|)"
        R"((\.|->)wait_for\(|(\.|->)wait_until\(|yield\(\)|alarm\(|setitimer|\.patience =|)"
        R"("sleep"|--seconds|--timeout)");
    std::set<std::string> found;
    for (const std::string& file : sources(root, "tests")) {
        if (file.starts_with("tests/bench/") || file == "tests/house/clocks_test.cpp")
            continue;
        std::ifstream text(root / file);
        const std::string all{std::istreambuf_iterator<char>(text), {}};
        if (std::regex_search(all, clock))
            found.insert(file);
    }
    return found;
}

TEST(Clocks, ATestThatLooksAtOneHasAReason) {
    std::set<std::string> listed;
    for (const auto& [file, reason] : kReasons)
        listed.insert(file);
    EXPECT_EQ(files_with_clocks(checkout()), listed);
}

TEST(Clocks, AreFound) {
    const PlantedTree tree;
    tree.plant("tests/a_test.cpp", "std::this_thread::sleep_for(20ms);\n");
    tree.plant("tests/b_test.cpp", "const auto start = std::chrono::steady_clock::now();\n");
    tree.plant("tests/c_test.cpp", "while (!done)\n    std::this_thread::yield();\n");
    tree.plant("tests/d_test.cpp", "screen.xdotool({\"key\", \"a\", \"sleep\", \"0.2\"});\n");
    tree.plant("tests/e_test.cpp", "const auto asleep = eventually([] { return true; });\n");
    EXPECT_EQ(files_with_clocks(tree.root()),
              (std::set<std::string>{"tests/a_test.cpp", "tests/b_test.cpp", "tests/c_test.cpp",
                                     "tests/d_test.cpp"}));
}

} // namespace
} // namespace isochron::house
