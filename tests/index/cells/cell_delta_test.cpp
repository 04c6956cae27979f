// Differences between steps and between isovalues equal those of the sets themselves.
#include "tests/index/cells/cell_series.h"

#include "index/volume/ordinal.h"

#include <gtest/gtest.h>

#include <cmath>

namespace isochron::index {
namespace {

std::vector<CellId> minus(const std::vector<CellId>& a, const std::vector<CellId>& b) {
    std::vector<CellId> left;
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(left));
    return left;
}

TestField::Function sine_wave() {
    return [](double x, double y, double z, double t) {
        return 127 + 120 * std::sin(0.3 * x + 0.2 * y + 0.1 * z + 0.02 * t);
    };
}

void expect_changes(const TestField& field, const std::vector<double>& isovalues) {
    const CellSeries series(field.view(), LevelMap::of_type(field.view().type));
    const CellTier tier = series.tier();
    for (const double isovalue : isovalues) {
        const auto cut = series.cut(isovalue).value();
        std::vector<CellId> before = BruteForce(field.view(), 0).active(isovalue);
        for (std::uint32_t step = 1; step < field.view().steps; ++step) {
            std::vector<CellId> after = BruteForce(field.view(), step).active(isovalue);
            std::vector<IdRun> added, removed;
            tier.change(step - 1, step, cut, added, removed);
            ASSERT_EQ(sorted_ids(added), minus(after, before)) << step << ' ' << isovalue;
            ASSERT_EQ(sorted_ids(removed), minus(before, after)) << step << ' ' << isovalue;
            std::vector<IdRun> back_added, back_removed;
            tier.change(step, step - 1, cut, back_added, back_removed);
            ASSERT_EQ(sorted_ids(back_added), sorted_ids(removed));
            ASSERT_EQ(sorted_ids(back_removed), sorted_ids(added));
            before = std::move(after);
        }
    }
}

TEST(CellDeltas, AreTheSetDifferencesOfNeighboringSteps) {
    std::mt19937 random(test_seed());
    std::vector<double> isovalues;
    for (int k = 1; k < 256; k += 7)
        isovalues.insert(isovalues.end(), {k - 0.5, k * 1.0});
    expect_changes(TestField({30, 28, 29}, 7, ValueType::u8, moving_sphere), isovalues);
    expect_changes(TestField({13, 12, 11}, 7, ValueType::u8, scaled(turbulence(random), 250, 127)),
                   isovalues);
    expect_changes(TestField({13, 12, 11}, 5, ValueType::u8, scaled(white_noise(random), 127, 128)),
                   isovalues);
    expect_changes(TestField({90, 85, 10}, 3, ValueType::u8, scaled(white_noise(random), 127, 128)),
                   {3, 100, 127.5, 250});
}

TEST(CellDeltas, CrossTheBorderOfEpochs) {
    // So fast that every step differs from the one before.
    const auto wave = [](double x, double y, double z, double t) {
        return 127 + 120 * std::sin(0.9 * x + 0.2 * y + 0.1 * z + 1.7 * t);
    };
    expect_changes(TestField({9, 5, 4}, 520, ValueType::u8, wave), {30, 127, 200.5});
}

TEST(CellDeltas, HoldACellTwiceWhereItsIntervalGrowsOnBothSides) {
    // Every cell of a full stretch goes from (100, 150] to (90, 160] and back.
    const TestField field({258, 256, 2}, 3, ValueType::u8, [](double, double, double z, double t) {
        const double grown = t == 1 ? 10 : 0;
        return z == 0 ? 100 - grown : 150 + grown;
    });
    expect_changes(field, {91, 95, 100, 101, 120, 150, 151, 160});
    const CellSeries series(field.view(), LevelMap::of_type(ValueType::u8));
    const DeltaUnit unit(series.deltas.front(), 0);
    EXPECT_EQ(unit.entries(), (std::vector<std::uint32_t>{0, 0, 2 * 65535, 0, 0, 2 * 65535}));
}

TEST(CellDeltas, KnowCellsThatComeAndGoWithANaN) {
    std::mt19937 random(test_seed());
    TestField field({8, 7, 6}, 6, ValueType::f32,
                    [&](double, double, double, double) { return below(random, 9); });
    for (int i = 0; i < 60; ++i)
        field.at<float>(below(random, 6), below(random, 336)) =
            std::numeric_limits<float>::quiet_NaN();
    std::vector<std::uint64_t> values;
    for (int k = 0; k < 9; ++k)
        values.push_back(ordinal(static_cast<float>(k)));
    const CellSeries series(field.view(), LevelMap::of_values(ValueType::f32, values));
    const CellTier tier = series.tier();
    for (std::uint32_t step = 1; step < 6; ++step)
        for (int k = 1; k < 9; ++k) {
            const auto before = BruteForce(field.view(), step - 1).active(k);
            const auto after = BruteForce(field.view(), step).active(k);
            std::vector<IdRun> added, removed;
            tier.change(step - 1, step, series.cut(k).value(), added, removed);
            ASSERT_EQ(sorted_ids(added), minus(after, before));
            ASSERT_EQ(sorted_ids(removed), minus(before, after));
        }
}

TEST(CellTier, KnowsWhatDiffersBetweenAnyTwoSteps) {
    const TestField field({9, 8, 7}, 300, ValueType::u8, sine_wave());
    const CellSeries series(field.view(), LevelMap::of_type(ValueType::u8));
    const CellTier tier = series.tier();
    std::mt19937 random(test_seed());
    for (int trial = 0; trial < 300; ++trial) {
        const std::uint32_t a = below(random, 300);
        const std::uint32_t b = trial % 3 ? below(random, 300) : std::min(a + 1, 299u);
        const double isovalue = 1 + below(random, 250);
        std::vector<IdRun> only_a, only_b;
        tier.difference(a, b, series.cut(isovalue).value(), only_a, only_b);
        const auto in_a = BruteForce(field.view(), a).active(isovalue);
        const auto in_b = BruteForce(field.view(), b).active(isovalue);
        ASSERT_EQ(minus(sorted_ids(only_a), sorted_ids(only_b)), minus(in_a, in_b));
        ASSERT_EQ(minus(sorted_ids(only_b), sorted_ids(only_a)), minus(in_b, in_a));
    }
}

TEST(CellTier, KnowsWhatDiffersBetweenAnyTwoIsovalues) {
    std::mt19937 random(test_seed());
    const TestField turbulent({24, 22, 20}, 6, ValueType::u8, scaled(turbulence(random), 250, 127));
    std::vector<std::uint64_t> thresholds;
    for (std::uint64_t k = 3; k < 250; k += 5)
        thresholds.push_back(k);
    for (const LevelMap& map :
         {LevelMap::of_type(ValueType::u8), LevelMap::of_thresholds(ValueType::u8, thresholds)}) {
        const CellSeries series(turbulent.view(), map);
        const CellTier tier = series.tier();
        for (int trial = 0; trial < 400; ++trial) {
            const std::uint32_t step = below(random, 6);
            // Both of them on thresholds of either map.
            const double from = 3 + 5.0 * (below(random, 49)), to = 3 + 5.0 * (below(random, 49));
            const auto before = BruteForce(turbulent.view(), step).active(from);
            const auto after = BruteForce(turbulent.view(), step).active(to);
            std::vector<IdRun> added, removed;
            tier.level_difference(step, series.cut(from).value(), series.cut(to).value(), added,
                                  removed);
            ASSERT_EQ(sorted_ids(added), minus(after, before)) << from << " to " << to;
            ASSERT_EQ(sorted_ids(removed), minus(before, after)) << from << " to " << to;
        }
    }
}

} // namespace
} // namespace isochron::index
