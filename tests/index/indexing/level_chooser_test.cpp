// Levels are lossless if possible, else divide values well, and depend on nothing but the values.
#include "index/indexing/level_chooser.h"

#include "index/volume/ordinal.h"
#include "tests/support/test_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochron::index {
namespace {

std::span<const std::byte> bytes(const std::vector<float>& values) {
    return std::as_bytes(std::span(values));
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

TEST(LevelChooser, AStepOfFewValuesIsLosslessForEveryType) {
    std::mt19937 random(test_seed());
    for (const ValueType type :
         {ValueType::i16, ValueType::u16, ValueType::i32, ValueType::f32, ValueType::f64}) {
        const TestField field({20, 20, 20}, 1, type, [&](double x, double y, double z, double t) {
            return 100 + std::round(127 * std::sin(x + y * z + t)); // at most 255 values
        });
        LevelChooser chooser(type);
        chooser.add(field.view().step_bytes(0));
        const LevelMap levels = chooser.choose();
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
        LevelChooser one(ValueType::f32), halves(ValueType::f32);
        one.add(bytes(values));
        EXPECT_EQ(one.choose().lossless(), distinct == 256);
        // Each half has fewer.
        std::sort(values.begin() + 1, values.end());
        const std::size_t half = 2500;
        halves.add({0, half, values.size()}, bytes(values).first(half * sizeof(float)));
        EXPECT_TRUE(halves.choose().lossless());
        halves.add({half, values.size(), values.size()},
                   bytes(values).subspan(half * sizeof(float)));
        EXPECT_EQ(halves.choose().lossless(), distinct == 256);
    }
}

TEST(LevelChooser, DividesSmoothValuesEvenly) {
    std::mt19937 random(test_seed());
    std::uniform_real_distribution<float> uniform(300, 301);
    std::vector<float> values(200'000);
    for (float& value : values)
        value = uniform(random);
    LevelChooser chooser(ValueType::f32);
    chooser.add(bytes(values));
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
    chooser.add(bytes(values));
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
    chooser.add(bytes(values));
    const LevelMap levels = chooser.choose();
    const auto tail = std::count_if(
        levels.thresholds().begin(), levels.thresholds().end(),
        [](std::uint64_t number) { return number > ordinal(4.0f); }); // above are 2 % of the values
    EXPECT_GE(tail, 15);
}

TEST(LevelChooser, NothingButNanIsOneLevel) {
    LevelChooser chooser(ValueType::f32);
    chooser.add(bytes(std::vector<float>(100, float(kNaN))));
    EXPECT_EQ(chooser.choose().levels(), 1u);
    EXPECT_EQ(LevelChooser(ValueType::f64).choose().levels(), 1u);
}

} // namespace
} // namespace isochron::index
