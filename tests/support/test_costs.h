// What a test has cost so far in this process: counted where it is linked to (`tests/CMakeLists.txt`, --wrap).
#pragma once

#include <atomic>

namespace isochron::test_support {

struct TestCosts {
    std::atomic<long> processes{0}; ///< started by the test, or by the program's code within it
    std::atomic<long> contexts{0};  ///< GL contexts made
    std::atomic<long> draws{0};     ///< calls of GL's drawing functions
};

inline TestCosts& test_costs() {
    static TestCosts costs;
    return costs;
}

} // namespace isochron::test_support
