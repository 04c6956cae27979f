// The seed of the tests that draw their input at random.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace isochron {

/// 1, so that the same program gives the same verdict, or ISOCHRON_SEED=n. Printed, so that a
/// failure under another seed can be repeated.
inline std::uint32_t test_seed() {
    const char* given = std::getenv("ISOCHRON_SEED");
    const auto seed = given ? static_cast<std::uint32_t>(std::strtoul(given, nullptr, 10)) : 1u;
    std::printf("ISOCHRON_SEED=%u\n", seed);
    return seed;
}

} // namespace isochron
