// The benchmark counts, times and reports what is there.
#include "tests/bench/measures/errors.h"
#include "tests/bench/measures/isovalues.h"
#include "tests/bench/measures/stopwatch.h"
#include "tests/bench/measures/structures.h"
#include "tests/bench/measures/timing.h"

#include "index/indexing/index_build.h"
#include "index/scan/scan.h"
#include "tests/support/memory_series.h"
#include "tests/support/test_folder.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace isochron::bench {
namespace {

using index::Query;
using index::TestField;
using index::ValueType;
using testing::ElementsAre;

double mean_active(const index::StepValues& values, double isovalue) {
    double sum = 0;
    for (std::uint32_t step = 0; step < values.steps; ++step) {
        Ids found;
        index::scan(values, {index::Instant(step), isovalue}, found);
        sum += static_cast<double>(found.size());
    }
    return sum / static_cast<double>(values.steps);
}

TEST(ErrorCount, TellsWhatIsMissingFromWhatIsTooMuch) {
    const TestField field({20, 19, 18}, 2, ValueType::u8, index::moving_sphere);
    const std::vector<double> isovalues{20, 60};
    std::uint64_t active = 0;
    Structure structure;
    structure.ids = [&](const Query& query, Ids& out) {
        out.clear();
        index::scan(field.view(), query, out);
        active += out.size();
        ASSERT_GT(out.size(), 10u);
        out.erase(out.begin() + 3, out.begin() + 5); // two are missing,
        out.push_back(out.front());                  // one is there twice,
        out.push_back(out.front() + 20 * 19 * 18);   // and one is no cell
    };
    double done = -1;
    const ErrorCount count =
        count_errors(field.view(), structure, isovalues, [&](double fraction) { done = fraction; });
    EXPECT_EQ(count.active, active);
    EXPECT_EQ(count.false_negatives, 2u * 4);
    EXPECT_EQ(count.false_positives, 2u * 4);
    EXPECT_EQ(done, 0.5);
}

TEST(Structures, AreExactWhereTheyDoNotSayThatTheyReturnCandidates) {
    const test_support::TestFolder folder;
    const TestField field({18, 17, 16}, 6, ValueType::u8, index::moving_sphere);
    index::MemorySeries series(field.view());
    index::build_index(series, folder.path() / "a.isochron", {});
    const auto file = index::IndexFile::open(folder.path() / "a.isochron");
    const auto isovalues = quantile_isovalues(file->values(), 20);
    std::vector<std::string> names;
    for (const Recipe& recipe :
         structures_of(file, build_tbon(file, 1),
                       {.lattices = {32, 64}, .max_variations = {2}, .threads = 1})) {
        const Structure structure = recipe.build({});
        names.push_back(structure.name);
        const ErrorCount count = count_errors(file->values(), structure, isovalues, [](double) {});
        EXPECT_GT(count.active, 1000u);
        EXPECT_EQ(count.false_negatives, 0u) << structure.name;
        EXPECT_EQ(count.false_positives > 0, structure.candidates) << structure.name;
        if (!structure.follow)
            continue;
        for (const std::uint32_t step : {0u, 1u, 5u, 2u}) {
            Ids found;
            structure.ids({index::Instant(step), 60}, found);
            EXPECT_EQ(structure.follow({index::Instant(step), 60}), found.size());
        }
    }
    EXPECT_THAT(names, ElementsAre("scan", "tbon", "bricks", "thi", "thi-node-lattices",
                                   "thi-interval-trees", "thi-compact-lists", "thi",
                                   "thi-node-lattices", "thi-interval-trees", "thi-compact-lists"));
}

TEST(Isovalues, AreTheQuantilesOfAllSteps) {
    const TestField field(
        {10, 10, 10}, 3, ValueType::i16,
        [](double x, double y, double z, double t) { return x + 10 * y + 100 * z + 1000 * t; });
    EXPECT_THAT(quantile_isovalues(field.view(), 2), ElementsAre(1000, 2000));
    EXPECT_THAT(quantile_isovalues(field.view(), 5), ElementsAre(500, 1000, 1500, 2000, 2500));
    const TestField nothing({2, 2, 2}, 1, ValueType::f32,
                            [](double, double, double, double) { return std::nan(""); });
    EXPECT_TRUE(quantile_isovalues(nothing.view(), 5).empty());
}

TEST(Isovalues, HaveAsManyActiveCellsAsAskedFor) {
    for (const ValueType type : {ValueType::u8, ValueType::f32}) {
        const TestField field({40, 40, 40}, 3, type, index::moving_sphere);
        const double isovalue = isovalue_with(field.view(), 2000);
        EXPECT_NEAR(mean_active(field.view(), isovalue), 2000, 60) << isovalue;
        EXPECT_TRUE(type == ValueType::f32 || isovalue - std::floor(isovalue) == 0.5) << isovalue;
    }
    const TestField field({40, 40, 40}, 3, ValueType::f32, index::moving_sphere);
    EXPECT_GT(mean_active(field.view(), isovalue_with(field.view(), 1e9)), 2000) << "most there is";
}

TEST(Timing, TakesTheMiddle) {
    EXPECT_EQ(median({3}), 3);
    EXPECT_EQ(median({5, 1, 3}), 3);
    EXPECT_EQ(median({4, 1, 3, 2}), 2.5);
}

TEST(Timing, RunsEveryOperationAtEveryStepInTurn) {
    std::vector<std::string> order;
    const auto slow = [&](const char* name) -> Operation {
        return [&order, name](std::uint32_t step) {
            order.push_back(name + std::to_string(step));
            const Stopwatch watch;
            while (watch.seconds() < 0.006) {
            }
        };
    };
    const auto seconds = time_in_turn({slow("a"), slow("b")}, 2, 2);
    EXPECT_THAT(order, ElementsAre("a0", "b0", "a1", "b1", "a0", "b0", "a1", "b1"))
        << "slow ones once a round";
    ASSERT_EQ(seconds.size(), 2u);
    EXPECT_GE(seconds[0], 0.006);
    int quick = 0;
    time_in_turn({[&](std::uint32_t) { ++quick; }}, 1, 3);
    EXPECT_GT(quick, 3 * 3) << "more often than a slow one; how often depends on the clock's cost";
}

TEST(Timing, SweepsForwardsAndBackwards) {
    std::vector<std::uint32_t> visited;
    time_sweep([&](std::uint32_t step) { visited.push_back(step); }, 3, 1);
    EXPECT_THAT(visited, ElementsAre(0, 1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0)) << "once to warm up";
}

} // namespace
} // namespace isochron::bench
