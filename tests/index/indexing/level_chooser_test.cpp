// Levels are lossless if possible, else divide values well, and depend on nothing but the values.
#include "index/indexing/level_chooser.h"

#include "index/volume/ordinal.h"
#include "tests/support/test_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace isochron::index {
namespace {

std::span<const std::byte> bytes(const std::vector<float>& values) {
    return std::as_bytes(std::span(values));
}

std::span<const std::byte> step_bytes(const StepValues& values, std::size_t step) {
    return {values.first + step * values.stride, values.grid.vertex_count() * size_of(values.type)};
}

LevelMap choose_levels(const StepValues& values) {
    LevelChooser chooser(values.type);
    for (std::size_t step = 0; step < values.steps; ++step)
        chooser.add(step, step_bytes(values, step));
    return chooser.choose();
}

/// How many of the values have each rank.
std::vector<std::size_t> histogram(const LevelMap& levels, const std::vector<float>& values) {
    std::vector<std::uint8_t> ranks(values.size());
    levels.ranks(bytes(values), ranks);
    std::vector<std::size_t> counts(LevelMap::kMaxLevels);
    for (const std::uint8_t rank : ranks)
        ++counts[rank];
    return counts;
}

TEST(LevelChooser, EightBitTypesHaveALevelForEveryValue) {
    for (const ValueType type : {ValueType::i8, ValueType::u8})
        EXPECT_EQ(LevelChooser(type).choose(), LevelMap::of_type(type));
}

TEST(LevelChooser, ASeriesOfFewValuesIsLosslessForEveryType) {
    std::mt19937 random(test_seed());
    for (const ValueType type :
         {ValueType::i16, ValueType::u16, ValueType::i32, ValueType::f32, ValueType::f64}) {
        const TestField field({20, 20, 20}, 3, type, [&](double x, double y, double z, double t) {
            return 100 + std::round(127 * std::sin(x + y * z + t)); // at most 255 values
        });
        const LevelMap levels = choose_levels(field.view());
        EXPECT_TRUE(levels.lossless()) << name_of(type);
        const std::vector<double> sorted = sorted_values(field.view());
        EXPECT_EQ(levels.cut({}, sorted.front()), std::nullopt);
        EXPECT_EQ(levels.cut({}, sorted.back()),
                  (LevelMap::Cut{static_cast<std::uint8_t>(levels.levels() - 1), true}));
    }
}

TEST(LevelChooser, Exactly256ValuesAreFewAnd257AreMany) {
    for (const int distinct : {256, 257}) {
        std::vector<float> values{float(kNaN), -0.0f, 0.0f};
        for (int i = 0; i < 5000; ++i)
            values.push_back(float(i % distinct) * 0.25f);
        LevelChooser one(ValueType::f32), first(ValueType::f32), second(ValueType::f32);
        one.add(0, bytes(values));
        EXPECT_EQ(one.choose().lossless(), distinct == 256);
        // Each half has fewer.
        std::sort(values.begin() + 1, values.end());
        const std::vector<float> low(values.begin(), values.begin() + 2500);
        const std::vector<float> high(values.begin() + 2500, values.end());
        first.add(0, bytes(low));
        second.add(1, bytes(high));
        EXPECT_TRUE(first.choose().lossless());
        EXPECT_TRUE(second.choose().lossless());
        first.merge(second);
        EXPECT_EQ(first.choose().lossless(), distinct == 256);
    }
}

TEST(LevelChooser, DoesNotDependOnWhoHasSeenWhichStep) {
    std::mt19937 random(test_seed());
    // More samples than are kept.
    const TestField field({16, 16, 16}, 80, ValueType::f32, turbulence(random));
    const StepValues values = field.view();
    const LevelMap expected = choose_levels(values);
    EXPECT_GE(expected.levels(), 250u);
    for (const std::size_t workers : {2u, 3u, 7u}) {
        std::vector<std::size_t> steps(values.steps);
        std::iota(steps.begin(), steps.end(), std::size_t{0});
        std::shuffle(steps.begin(), steps.end(), random);
        std::vector<LevelChooser> choosers(workers, LevelChooser(values.type));
        for (std::size_t i = 0; i < steps.size(); ++i)
            choosers[random() % workers].add(steps[i], step_bytes(values, steps[i]));
        std::shuffle(choosers.begin(), choosers.end(), random);
        LevelChooser all(values.type);
        for (const LevelChooser& chooser : choosers)
            all.merge(LevelChooser(values.type, chooser.state())); // as between processes
        EXPECT_EQ(all.choose(), expected) << workers;
    }
}

TEST(LevelChooser, DividesSmoothValuesEvenly) {
    std::mt19937 random(test_seed());
    std::uniform_real_distribution<float> uniform(300, 301);
    std::vector<float> values(200'000);
    for (float& value : values)
        value = uniform(random);
    LevelChooser chooser(ValueType::f32);
    chooser.add(0, bytes(values));
    const LevelMap levels = chooser.choose();
    EXPECT_GE(levels.levels(), 240u);
    const auto counts = histogram(levels, values);
    EXPECT_LT(*std::max_element(counts.begin(), counts.end()), 5 * values.size() / 256);
}

TEST(LevelChooser, ABackgroundAndOutliersTakeFewLevels) {
    std::mt19937 random(test_seed());
    std::uniform_real_distribution<float> uniform(0, 1);
    std::vector<float> values(200'000), inner;
    for (float& value : values) {
        const float chance = uniform(random);
        if (chance < 0.85f) {
            value = -9999;
        } else if (chance < 0.86f) {
            value = chance < 0.855f ? float(kInfinity) : 1e30f;
        } else if (chance < 0.87f) {
            value = float(kNaN);
        } else {
            value = 20 + uniform(random);
            inner.push_back(value);
        }
    }
    LevelChooser chooser(ValueType::f32);
    chooser.add(0, bytes(values));
    const auto counts = histogram(chooser.choose(), inner);
    EXPECT_GE(std::count_if(counts.begin(), counts.end(), [](auto n) { return n > 0; }), 100);
    EXPECT_LT(*std::max_element(counts.begin(), counts.end()), inner.size() / 20);
}

TEST(LevelChooser, ALongTailIsDividedByItsRange) {
    std::mt19937 random(test_seed());
    std::exponential_distribution<float> exponential(1);
    std::vector<float> values(200'000);
    for (float& value : values)
        value = exponential(random);
    LevelChooser chooser(ValueType::f32);
    chooser.add(0, bytes(values));
    const LevelMap levels = chooser.choose();
    const auto tail = std::count_if(
        levels.thresholds().begin(), levels.thresholds().end(),
        [](std::uint64_t number) { return number > ordinal(4.0f); }); // above are 2 % of the values
    EXPECT_GE(tail, 15);
}

TEST(LevelChooser, NothingButNanIsOneLevel) {
    LevelChooser chooser(ValueType::f32);
    chooser.add(0, bytes(std::vector<float>(100, float(kNaN))));
    EXPECT_EQ(chooser.choose().levels(), 1u);
    EXPECT_EQ(LevelChooser(ValueType::f64).choose().levels(), 1u);
}

} // namespace
} // namespace isochron::index
