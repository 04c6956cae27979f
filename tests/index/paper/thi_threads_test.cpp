// Building the THI tree on several threads: the same bytes for any number, and it can be canceled.
#include "index/paper/thi_tree.h"

#include "tests/support/test_field.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace isochron::index {
namespace {

TEST(ThiThreads, HasTheSameBytesForEveryNumberOfThreads) {
    std::mt19937 random(test_seed());
    // More cells than fit into one batch of the builder.
    const TestField field({70, 41, 20}, 12, ValueType::f32, turbulence(random));
    const auto one = build_thi_tree(field.view(), {32, 2}, {}, 1);
    for (const unsigned threads : {2u, 3u, 8u})
        EXPECT_EQ(one, build_thi_tree(field.view(), {32, 2}, {}, threads)) << threads;
}

TEST(ThiThreads, StopsWhenProgressThrowsInAnyPhase) {
    const TestField field({20, 20, 20}, 6, ValueType::f32, moving_sphere);
    std::vector<std::string> phases;
    const auto whole = build_thi_tree(field.view(), {}, [&](std::string_view phase, double done) {
        EXPECT_GE(done, 0);
        EXPECT_LE(done, 1);
        if (phases.empty() || phases.back() != phase)
            phases.emplace_back(phase);
    });
    EXPECT_EQ(phases.size(), 3u);
    struct Canceled {};
    for (const std::string& last : phases)
        EXPECT_THROW(build_thi_tree(
                         field.view(), {},
                         [&](std::string_view phase, double) {
                             if (phase == last)
                                 throw Canceled{};
                         },
                         4),
                     Canceled);
}

} // namespace
} // namespace isochron::index
