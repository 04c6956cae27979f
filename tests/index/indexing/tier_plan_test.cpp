// The choice of tiers for a series, and their figures.
#include "index/error.h"
#include "index/file/index_file.h"
#include "index/indexing/index_build.h"
#include "index/indexing/tier_plan.h"
#include "tests/support/memory_series.h"
#include "tests/support/test_field.h"
#include "tests/support/test_folder.h"
#include "tests/support/test_seed.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace isochron::index {
namespace {

using test_support::TestFolder;
using testing::HasSubstr;

/// A series of so many steps that are all alike.
StepValues standing(const TestField& field, std::size_t steps) {
    StepValues values = field.view();
    values.steps = steps;
    values.stride = 0;
    return values;
}

std::string reasons_of(const TierPlan& plan) {
    return fmt::format("{}", fmt::join(plan.reasons, "; "));
}

TEST(TierPlan, CellsOfManySmallStepsPayForTheirBytes) {
    const TestField field({40, 40, 40}, 1, ValueType::u8, moving_sphere);
    const TierPlan plan =
        plan_tiers(standing(field, 10'000), LevelMap::of_type(ValueType::u8), std::nullopt);
    EXPECT_TRUE(plan.tiers.has(Tier::cells));
    EXPECT_FALSE(plan.tiers.has(Tier::deltas));
    EXPECT_THAT(reasons_of(plan), HasSubstr("no deltas: they would take 0."));
    EXPECT_THAT(reasons_of(plan), HasSubstr("cells pay: 0.0"));
    EXPECT_THAT(reasons_of(plan), HasSubstr("bytes for each byte of values"));
}

TEST(TierPlan, CellsBesideAllElseTakeAtMostSixFifthsOfTheValues) {
    const TestField field({40, 40, 40}, 1, ValueType::u8, moving_sphere);
    const auto tiers_beside = [&](double others) {
        return plan_tiers(standing(field, 10'000), LevelMap::of_type(ValueType::u8), std::nullopt,
                          others)
            .tiers;
    };
    EXPECT_TRUE(tiers_beside(1.1).has(Tier::cells));
    EXPECT_FALSE(tiers_beside(1.2).has(Tier::cells));
}

TEST(TierPlan, OfSmallSeriesKeepsTheIndexNearTheSizeOfTheData) {
    std::mt19937 random(test_seed());
    for (const bool still : {true, false}) {
        const TestFolder folder;
        const auto moving = turbulence(random), at_rest = turbulence(random);
        const TestField field(
            {64, 64, 64}, 12, ValueType::u8, [&](double x, double y, double z, double t) {
                return 120 + 30 * (still ? at_rest(x, y, z, 0) : moving(x, y, z, t));
            });
        MemorySeries series(field.view());
        build_index(series, folder.path() / "a", {});
        const auto file = IndexFile::open(folder.path() / "a");
        const double data = 12.0 * 64 * 64 * 64;
        EXPECT_LT(static_cast<double>(file->stats().file_bytes), 1.2 * data) << still;
        EXPECT_EQ(file->plan().tiers.has(Tier::cells), still);
    }
}

TEST(TierPlan, CellsOfLargeStepsAreNotEvenLookedAt) {
    StepValues values{.grid = {.vertices = {512, 512, 512}},
                      .type = ValueType::u8,
                      .scaling = {},
                      .steps = 1000,
                      .first = nullptr,
                      .stride = 1 << 27};
    const TierPlan plan = plan_tiers(values, LevelMap::of_type(ValueType::u8), std::nullopt);
    EXPECT_EQ(plan.tiers, TierSet().with(Tier::bricks));
    EXPECT_THAT(reasons_of(plan), HasSubstr("no cells: a step has 128 MiB"));
}

TEST(TierPlan, GridsOf2To32CellsGetNeitherCellsNorTheTree) {
    Grid grid;
    grid.vertices = {2048, 2048, 2048};
    EXPECT_NO_THROW(check_tiers(grid, TierSet().with(Tier::bricks)));
    for (const Tier tier : {Tier::cells, Tier::tree})
        EXPECT_THROW(check_tiers(grid, TierSet().with(tier)), Error);
}

} // namespace
} // namespace isochron::index
