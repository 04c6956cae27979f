// Runs are expanded to ids, for all lengths and instruction sets.
#include "index/cells/id_runs.h"

#include "tests/support/test_seed.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <random>

namespace isochron::index {
namespace {

TEST(IdRuns, BecomeTheSameIdsOnEveryTarget) {
    std::mt19937 random(test_seed());
    std::vector<std::uint16_t> ids(5000);
    for (std::uint16_t& id : ids)
        id = static_cast<std::uint16_t>(random());
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        std::vector<CellId> found; // kept, as it is from search to search
        for (int trial = 0; trial < 300; ++trial) {
            std::vector<IdRun> runs;
            std::vector<CellId> expected;
            for (int n = static_cast<int>(random() % 20); n > 0; --n) {
                const auto count = static_cast<std::uint32_t>(
                    random() % (random() % 4 ? 50 : ids.size() - IdRun::kSlack));
                const std::size_t at = random() % (ids.size() - IdRun::kSlack - count + 1);
                const auto first = static_cast<CellId>(random());
                runs.push_back({ids.data() + at, count, first});
                for (std::uint32_t i = 0; i < count; ++i)
                    expected.push_back(first + ids[at + i]);
            }
            assign_ids(runs, found);
            ASSERT_EQ(found, expected) << hwy::TargetName(target);
            EXPECT_EQ(count_ids(runs), expected.size());
        }
    }
    hwy::SetSupportedTargetsForTest(0);
}

} // namespace
} // namespace isochron::index
