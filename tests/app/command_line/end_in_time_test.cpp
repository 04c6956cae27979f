// A process that was signaled ends soon, whatever its threads do, with its files cleaned up and its work
// saved.
#include "app/end_in_time.h"

#include "index/system/new_file.h"
#include "tests/support/test_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace isochron::app {
namespace {

using test_support::TestFolder;
using namespace std::chrono_literals;

/// Runs in a process of its own: what never ends by itself.
[[noreturn]] void hang_for_ever() {
    for (;;)
        std::this_thread::sleep_for(1h);
}

void begin_to_watch() {
    EndInTime::allow("lab");
    EndInTime::watch();
}

void make_stderr_a_full_pipe() {
    std::array<int, 2> ends{};
    const std::string page(4096, 'x');
    if (pipe2(ends.data(), O_NONBLOCK) != 0)
        _exit(1);
    while (write(ends[1], page.data(), page.size()) > 0)
        continue;
    fcntl(ends[1], F_SETFL, 0);
    dup2(ends[1], STDERR_FILENO);
}

class EndInTimeTest : public testing::Test {
  protected:
    EndInTimeTest() { setenv("XDG_STATE_HOME", home_.path().c_str(), 1); } // its ledger
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
    }
    TestFolder folder;

  private:
    TestFolder home_;
    std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

TEST_F(EndInTimeTest, EndsWhatDoesNotEndByItselfAndRemovesItsTemporaryFiles) {
    EXPECT_EXIT(
        {
            begin_to_watch();
            const index::NewFile file(folder.path() / "a", index::NewFile::Writers::several);
            if (std::filesystem::is_empty(folder.path()))
                _exit(1);
            EndInTime::signaled(SIGTERM);
            hang_for_ever();
        },
        testing::ExitedWithCode(128 + SIGTERM), "lab: canceled");
    EXPECT_LT(seconds(), 5) << "on a busy machine";
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST_F(EndInTimeTest, EndsWhereNobodyReadsWhatItSays) {
    EXPECT_EXIT(
        {
            begin_to_watch();
            make_stderr_a_full_pipe();
            EndInTime::signaled(SIGTERM);
            hang_for_ever();
        },
        testing::ExitedWithCode(128 + SIGTERM), "");
}

TEST_F(EndInTimeTest, SavesWhileItDrawsAndNotWhileWhatIsSavedMayChange) {
    EXPECT_EXIT(
        {
            begin_to_watch();
            bool whole = true;
            const SavedAtEnd saved([&] { folder.write(whole ? "whole" : "half", ""); });
            whole = false;
            EndInTime::signaled(SIGINT);
            std::this_thread::sleep_for(3 * EndInTime::kByItself);
            whole = true;
            const DrawsOnly draws;
            const DrawsOnly within;
            hang_for_ever();
        },
        testing::ExitedWithCode(128 + SIGINT), "lab: canceled");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"whole"});
}

/// Where the process may raise a thread's priority: a driver's threads of the lowest one would be its
/// last on a busy machine.
TEST_F(EndInTimeTest, GivesAllThreadsTheUsualPriority) {
    EXPECT_EXIT(
        {
            begin_to_watch();
            EndInTime::leave_to_the_job();
            const auto number = static_cast<id_t>(gettid());
            const int usual = getpriority(PRIO_PROCESS, number);
            std::thread([number, usual] {
                const auto own = static_cast<id_t>(gettid());
                setpriority(PRIO_PROCESS, own, 19);
                if (setpriority(PRIO_PROCESS, own, usual) != 0)
                    _exit(7); // it may not
                setpriority(PRIO_PROCESS, own, 19);
                EndInTime::signaled(SIGTERM);
                for (int i = 0; i < 20'000 && getpriority(PRIO_PROCESS, own) != usual; ++i)
                    std::this_thread::sleep_for(1ms);
                _exit(getpriority(PRIO_PROCESS, own) == usual &&
                              getpriority(PRIO_PROCESS, number) == usual
                          ? 7
                          : 8);
            }).join();
        },
        testing::ExitedWithCode(7), "");
}

TEST_F(EndInTimeTest, LeavesAloneWhatEndsByItselfAndJobsOfSeveralProcesses) {
    EXPECT_EXIT(
        {
            begin_to_watch();
            EndInTime::leave_to_the_job();
            EndInTime::signaled(SIGTERM);
            std::this_thread::sleep_for(3 * EndInTime::kByItself);
            _exit(EndInTime::is_first_to_tell() ? 7 : 8);
        },
        testing::ExitedWithCode(7), "");
}

} // namespace
} // namespace isochron::app
