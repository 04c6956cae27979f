// The choice of tiers for a series, and their figures.
#include "index/error.h"
#include "index/indexing/tier_plan.h"
#include "tests/support/test_field.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace isochron::index {
namespace {

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
    EXPECT_TRUE(plan.tiers.has(Tier::deltas));
    EXPECT_THAT(reasons_of(plan), HasSubstr("cells pay: 0.0"));
    EXPECT_THAT(reasons_of(plan), HasSubstr("bytes for each byte of values"));
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
