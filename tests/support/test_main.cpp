// The main function of every test program: GoogleTest's, and after each test lines that say what the test cost, and by
// which command it fails again.
#include "tests/support/test_costs.h"
#include "tests/support/test_seed.h"

#include <gmock/gmock.h>

#include <spawn.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>

// Calls of these functions in the objects of a test program lead here.
// NOLINTBEGIN(bugprone-reserved-identifier)
extern "C" {
pid_t __real_fork();
pid_t __wrap_fork() {
    ++isochron::test_support::test_costs().processes;
    return __real_fork();
}
int __real_posix_spawn(pid_t*, const char*, const posix_spawn_file_actions_t*,
                       const posix_spawnattr_t*, char* const[], char* const[]);
int __wrap_posix_spawn(pid_t* process, const char* path, const posix_spawn_file_actions_t* actions,
                       const posix_spawnattr_t* attributes, char* const arguments[],
                       char* const environment[]) {
    ++isochron::test_support::test_costs().processes;
    return __real_posix_spawn(process, path, actions, attributes, arguments, environment);
}
int __real_posix_spawnp(pid_t*, const char*, const posix_spawn_file_actions_t*,
                        const posix_spawnattr_t*, char* const[], char* const[]);
int __wrap_posix_spawnp(pid_t* process, const char* file, const posix_spawn_file_actions_t* actions,
                        const posix_spawnattr_t* attributes, char* const arguments[],
                        char* const environment[]) {
    ++isochron::test_support::test_costs().processes;
    return __real_posix_spawnp(process, file, actions, attributes, arguments, environment);
}
}
// NOLINTEND(bugprone-reserved-identifier)

namespace isochron::test_support {
namespace {

/// Processor time of this process and of those that it has waited for [ms].
long processor_time() {
    long sum = 0;
    for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage used{};
        getrusage(who, &used);
        sum += (used.ru_utime.tv_sec + used.ru_stime.tv_sec) * 1000 +
               (used.ru_utime.tv_usec + used.ru_stime.tv_usec) / 1000;
    }
    return sum;
}

/// Says after a test that failed by which command it fails again.
class RepeatingCommand final : public testing::EmptyTestEventListener {
    void OnTestEnd(const testing::TestInfo& test) override {
        if (!test.result()->Failed())
            return;
        const char* seed = std::getenv("ISOCHRON_SEED");
        std::printf("Repeat it: ISOCHRON_SEED=%s ISOCHRON_ROUNDS=%d %s --gtest_filter=%s.%s\n",
                    seed ? seed : "1", rounds_percent(), program_invocation_name,
                    test.test_suite_name(), test.name());
    }
};

/// Prints what `tests/run_suites.py` reads, when that asks for it.
class CostPrinter final : public testing::EmptyTestEventListener {
    void OnTestStart(const testing::TestInfo&) override {
        time_ = processor_time();
        const TestCosts& now = test_costs();
        processes_ = now.processes;
        contexts_ = now.contexts;
        draws_ = now.draws;
    }
    void OnTestEnd(const testing::TestInfo&) override {
        const TestCosts& now = test_costs();
        std::printf("[   COST   ] %ld ms, %ld processes, %ld contexts, %ld draws\n",
                    processor_time() - time_, now.processes - processes_, now.contexts - contexts_,
                    now.draws - draws_);
        std::fflush(stdout);
    }
    long time_ = 0, processes_ = 0, contexts_ = 0, draws_ = 0;
};

} // namespace
} // namespace isochron::test_support

int main(int argc, char** argv) {
    testing::InitGoogleMock(&argc, argv);
    testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
    listeners.Append(new isochron::test_support::RepeatingCommand);
    if (std::getenv("ISOCHRON_TEST_COSTS"))
        listeners.Append(new isochron::test_support::CostPrinter);
    return RUN_ALL_TESTS();
}
