// One fraction for all phases of a build.
#include "index/indexing/work_progress.h"

#include <gtest/gtest.h>

namespace isochron::index {
namespace {

TEST(WorkProgress, CountsAllPhasesAndNeverGoesBack) {
    std::vector<std::pair<std::string, double>> seen;
    WorkProgress work([&](std::string_view phase, double done) { seen.emplace_back(phase, done); });
    work.plan({{"reading", 60}, {"colors", 0}, {"cells", 30}, {"flushing", 10}});
    work.report("reading", 0.5);
    work.report("reading", 1);
    work.plan({{"reading", 60}, {"colors", 0}, {"flushing", 15}}); // there are no cells after all
    work.report("colors", 0.3);
    work.report("another", 0.5);
    work.report("flushing", 0.2);
    work.plan({{"reading", 60}, {"colors", 100}, {"flushing", 40}});
    work.report("colors", 0.2); // less than was told
    const std::vector<std::pair<std::string, double>> expected{
        {"reading", 0.3}, {"reading", 0.6},   {"colors", 0.8},
        {"another", 0.8}, {"flushing", 0.84}, {"colors", 0.84}};
    ASSERT_EQ(seen.size(), expected.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
        EXPECT_EQ(seen[i].first, expected[i].first);
        EXPECT_NEAR(seen[i].second, expected[i].second, 1e-12);
    }
}

} // namespace
} // namespace isochron::index
