// The seed of tests with random input, how often they try, and how a failure is repeated.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace isochron {

/// The environment's ISOCHRON_SEED, or 1, so that results repeat. It is printed, so that also a
/// crash with another seed can be repeated.
inline std::uint32_t test_seed() {
    const char* given = std::getenv("ISOCHRON_SEED");
    const auto seed = given ? static_cast<std::uint32_t>(std::strtoul(given, nullptr, 10)) : 1u;
    std::printf("ISOCHRON_SEED=%u\n", seed);
    return seed;
}

/// The share of their rounds that long random tests go [%]: the environment's ISOCHRON_ROUNDS, a
/// number or `full`. A third otherwise, as the same seed meets the same rounds in every run.
inline int rounds_percent() {
    const char* given = std::getenv("ISOCHRON_ROUNDS");
    return !given ? 33 : std::strcmp(given, "full") == 0 ? 100 : std::max(1, std::atoi(given));
}

/// How often a test repeats what is random in it, at least once. Under sanitizers everything takes
/// some ten times as long, so there it is a quarter: the fuzzing programs and long soaks go on
/// where this ends.
inline int tries(int whole) {
#ifdef ISOCHRON_SANITIZED
    whole /= 4;
#endif
    return std::max(1, whole * rounds_percent() / 100);
}

/// Says after a test that failed by which command it fails again.
class RepeatingCommand : public testing::EmptyTestEventListener {
    void OnTestEnd(const testing::TestInfo& test) override {
        if (!test.result()->Failed())
            return;
        const char* seed = std::getenv("ISOCHRON_SEED");
        std::printf("Repeat it: ISOCHRON_SEED=%s ISOCHRON_ROUNDS=%d %s --gtest_filter=%s.%s\n",
                    seed ? seed : "1", rounds_percent(), program_invocation_name,
                    test.test_suite_name(), test.name());
    }
};
inline const bool kTellsHowToRepeat = [] {
    testing::UnitTest::GetInstance()->listeners().Append(new RepeatingCommand);
    return true;
}();

} // namespace isochron
