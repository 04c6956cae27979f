// The seed of tests with random input, and how often they try.
#pragma once

#include <algorithm>
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

} // namespace isochron
