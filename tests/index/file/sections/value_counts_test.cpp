// Counts of values depend only on the values.
#include "index/file/sections/value_counts.h"
#include "tests/support/test_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace isochron::index {
namespace {

template <class T>
std::span<const std::byte> bytes_of_all(const std::vector<T>& values) {
    return std::as_bytes(std::span(values));
}

TEST(ValueCounts, AreTheSameInAnyOrderAndMergedInAnyParts) {
    std::mt19937 random(test_seed());
    for (int series = 0; series < 40; ++series) {
        std::vector<std::vector<double>> steps(2 + random() % 6);
        for (auto& step : steps) {
            // Steps of very different ranges, some of a single value.
            const double scale = std::ldexp(1.0, static_cast<int>(random() % 80) - 40);
            const double offset = random() % 2 ? scale * 1000 : -3;
            step.resize(1 + random() % 500);
            for (double& value : step)
                value = offset + scale * (static_cast<double>(random() % 1000) / 10 - 30);
            if (random() % 3 == 0)
                step[0] = std::nan("");
            if (random() % 5 == 0)
                step.back() = std::numeric_limits<double>::infinity();
        }
        ValueCounts forwards, backwards, merged;
        for (const auto& step : steps)
            forwards.add(ValueType::f64, {}, bytes_of_all(step));
        for (auto step = steps.rbegin(); step != steps.rend(); ++step)
            backwards.add(ValueType::f64, {}, bytes_of_all(*step));
        for (const auto& step : steps) {
            ValueCounts one;
            one.add(ValueType::f64, {}, bytes_of_all(step));
            merged.merge(ValueType::f64, one);
        }
        EXPECT_EQ(forwards, backwards);
        EXPECT_EQ(forwards, merged);
        EXPECT_TRUE(forwards.sound(ValueType::f64));
        std::uint64_t finite = 0;
        for (const auto& step : steps)
            finite += static_cast<std::uint64_t>(
                std::ranges::count_if(step, [](double v) { return std::isfinite(v); }));
        const auto histogram = forwards.histogram(ValueType::f64, {});
        EXPECT_EQ(std::accumulate(histogram.begin(), histogram.end(), std::uint64_t{0}), finite);
        EXPECT_LE(static_cast<std::int64_t>(forwards.bins.size()), ValueCounts::kMostBins);
    }
}

TEST(ValueCounts, OfManyBytesAreThoseOfTheSameInSmallPieces) {
    std::mt19937 random(test_seed());
    std::vector<std::uint8_t> values((5 << 20) / 4 + 13); // pairs, and some that are left over
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<std::uint8_t>(i % 7 == 0 ? random() : 100 + random() % 4);
    ValueCounts whole, pieces;
    whole.add(ValueType::u8, {}, bytes_of_all(values));
    const std::span<const std::byte> all = bytes_of_all(values);
    for (std::size_t first = 0; first < all.size(); first += 1009)
        pieces.add(ValueType::u8, {},
                   all.subspan(first, std::min<std::size_t>(1009, all.size() - first)));
    EXPECT_EQ(whole, pieces);
    for (std::size_t i = 0; i < whole.bins.size(); ++i)
        EXPECT_EQ(whole.bins[i],
                  static_cast<std::uint64_t>(std::ranges::count(
                      values, static_cast<std::uint8_t>(whole.first + static_cast<int>(i)))));
}

TEST(ValueCounts, OfBytesGiveTheirHistogramExactly) {
    std::mt19937 random(test_seed());
    for (const Scaling scaling : {Scaling{}, Scaling{-0.5, 3}, Scaling{0.1, -7}}) {
        std::vector<std::uint8_t> values(5000);
        for (auto& value : values)
            value = static_cast<std::uint8_t>(20 + random() % 200);
        ValueCounts counts;
        counts.add(ValueType::u8, scaling, bytes_of_all(values));
        std::vector<double> scaled_values;
        for (const auto value : values)
            scaled_values.push_back(scaling(value));
        const auto [low, high] = std::ranges::minmax(scaled_values);
        EXPECT_EQ(counts.scaled_low(scaling), low);
        EXPECT_EQ(counts.scaled_high(scaling), high);
        std::vector<std::uint64_t> expected(kHistogramBins);
        for (const double value : scaled_values)
            ++expected[static_cast<std::size_t>(
                std::min(255.0, (value / 2 - low / 2) * (256 / (high / 2 - low / 2))))];
        EXPECT_EQ(counts.histogram(ValueType::u8, scaling), expected);
    }
}

} // namespace
} // namespace isochron::index
