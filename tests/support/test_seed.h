// The seed of tests with random input.
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

} // namespace isochron
