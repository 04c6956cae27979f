// Changes between queries give the set of the second from that of the first.
#include "index/indexing/index_build.h"
#include "index/search/cell_change.h"
#include "tests/support/memory_series.h"
#include "tests/support/test_folder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace isochron::index {
namespace {

using test_support::TestFolder;

class CellChangeTest : public testing::Test {
  protected:
    std::shared_ptr<const IndexFile> indexed(const StepValues& values,
                                             const BuildOptions& options = {}) {
        MemorySeries series(values);
        build_index(series, folder_.path() / "a.isochron", options);
        return IndexFile::open(folder_.path() / "a.isochron");
    }

    /// Walks at random and compares every set with brute force. @return how often one was whole
    int walk(const std::shared_ptr<const IndexFile>& file, const StepValues& values, int length,
             std::vector<double> isovalues = {}) {
        std::mt19937 random(test_seed());
        if (isovalues.empty())
            isovalues = quantiles(sorted_values(values), 9);
        ChangeSearch search(file);
        Query at{Instant(0), isovalues.front()};
        std::vector<CellId> set = BruteForce(values, 0).active(at.isovalue);
        int whole = 0;
        for (int i = 0; i < length; ++i) {
            Query next = at;
            const auto steps = static_cast<std::uint32_t>(values.steps);
            switch (random() % 10) {
            case 0: next.isovalue = random() % 2 ? 1e9 : -1e9; break;
            case 1: next.instant = Instant(static_cast<std::uint32_t>(random()) % steps); break;
            case 2:
            case 3:
            case 4: next.isovalue = isovalues[random() % isovalues.size()]; break;
            case 5:
            case 6: next.instant = Instant(std::max(at.instant.step, 1u) - 1); break;
            default: next.instant = Instant(std::min(at.instant.step + 1, steps - 1));
            }
            const CellChange change = search(at, next);
            whole += change.whole;
            if (change.whole)
                set.clear();
            std::vector<CellId> added(change.added.begin(), change.added.end());
            std::vector<CellId> removed(change.removed.begin(), change.removed.end());
            std::ranges::sort(added);
            std::ranges::sort(removed);
            std::vector<CellId> kept;
            EXPECT_TRUE(std::includes(set.begin(), set.end(), removed.begin(), removed.end()));
            std::set_difference(set.begin(), set.end(), removed.begin(), removed.end(),
                                std::back_inserter(kept));
            set.clear();
            std::merge(kept.begin(), kept.end(), added.begin(), added.end(),
                       std::back_inserter(set));
            EXPECT_EQ(set, BruteForce(values, next.instant.step).active(next.isovalue))
                << at.instant.step << ' ' << at.isovalue << " to " << next.instant.step << ' '
                << next.isovalue;
            at = next;
        }
        return whole;
    }

    TestFolder folder_;
};

TEST_F(CellChangeTest, FollowsARandomWalkThroughStepsAndIsovalues) {
    std::mt19937 random(test_seed());
    for (const ValueType type : {ValueType::u8, ValueType::i8, ValueType::u16, ValueType::f32}) {
        SCOPED_TRACE(name_of(type));
        const TestField field({19, 17, 23}, 13, type,
                              scaled(turbulence(random), 60, size_of(type) == 4 ? 0 : 60));
        walk(indexed(field.view()), field.view(), 200);
    }
    const TestField sphere({30, 25, 28}, 20, ValueType::u8, moving_sphere);
    walk(indexed(sphere.view()), sphere.view(), 200, {40, 60, 112.5, 180});
    const TestField falling({30, 25, 28}, 20, ValueType::u8, moving_sphere, {-0.5, 3});
    for (const TierSet tiers :
         {TierSet().with(Tier::bricks), TierSet().with(Tier::tree), TierSet()})
        walk(indexed(falling.view(), {.tiers = tiers}), falling.view(), 200, {-40, -60, -70.5});
}

TEST_F(CellChangeTest, IsTheWholeSetWhereFewChunksStayAndNotWhereMostDo) {
    std::mt19937 random(test_seed());
    const auto waves = turbulence(random);
    for (const bool stays : {false, true}) {
        const TestField field({20, 20, 60}, 5, ValueType::f32,
                              [&](double x, double y, double z, double t) {
                                  return waves(x, y, z, stays && z > 10 ? 0 : t);
                              });
        const auto file = indexed(field.view());
        const double isovalue = quantiles(sorted_values(field.view()), 3)[1];
        ChangeSearch search(file);
        EXPECT_EQ(search({Instant(1), isovalue}, {Instant(2), isovalue}).whole, !stays);
        walk(file, field.view(), 50);
    }
}

} // namespace
} // namespace isochron::index
