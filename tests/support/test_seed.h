// The seed of tests with random input, and how often they try.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace isochron {

/// The environment's ISOCHRON_SEED, or 1, so that results repeat. It is printed, so that a failure
/// with another seed can be repeated.
inline std::uint32_t test_seed() {
    const char* given = std::getenv("ISOCHRON_SEED");
    const auto seed = given ? static_cast<std::uint32_t>(std::strtoul(given, nullptr, 10)) : 1u;
    std::printf("ISOCHRON_SEED=%u\n", seed);
    return seed;
}

/// How often a test repeats what is random in it. Under sanitizers everything takes some ten times
/// as long, so there it is a quarter: the fuzzing programs and long soaks go on where this ends.
constexpr int tries(int otherwise) {
#ifdef ISOCHRON_SANITIZED
    return otherwise / 4;
#else
    return otherwise;
#endif
}

} // namespace isochron
