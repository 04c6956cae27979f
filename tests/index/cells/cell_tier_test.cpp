// Cells give exactly what brute force gives, for every type of value, shape and level map.
#include "tests/index/cells/cell_series.h"

#include "index/volume/ordinal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <thread>

namespace isochron::index {
namespace {

template <class T>
std::vector<std::uint64_t> ordinals(const StepValues& values) {
    std::set<std::uint64_t> found;
    for (std::size_t t = 0; t < values.steps; ++t)
        for (const T value : values.step<T>(t))
            if (value == value)
                found.insert(ordinal(value));
    return {found.begin(), found.end()};
}

std::vector<std::uint64_t> distinct_ordinals(const StepValues& values) {
    return visit_value_type(values.type,
                            [&]<class T>(std::type_identity<T>) { return ordinals<T>(values); });
}

/// A lossy map of at most `levels` levels, each with as many values as the others.
LevelMap lossy_map(const StepValues& values, std::size_t levels) {
    const std::vector<std::uint64_t> all = distinct_ordinals(values);
    std::set<std::uint64_t> thresholds;
    for (std::size_t k = 1; k < levels; ++k)
        thresholds.insert(all[all.size() * k / levels]);
    return LevelMap::of_thresholds(values.type, std::vector(thresholds.begin(), thresholds.end()));
}

LevelMap lossless_map(const StepValues& values) {
    return size_of(values.type) == 1 ? LevelMap::of_type(values.type)
                                     : LevelMap::of_values(values.type, distinct_ordinals(values));
}

/// Values of the series, values between them, and values outside.
std::vector<double> isovalues(const StepValues& values, int n) {
    const std::vector<double> sorted = sorted_values(values);
    if (sorted.empty())
        return {0, 1};
    std::vector<double> all = quantiles(sorted, n);
    for (const double value : quantiles(sorted, n / 2 + 1)) {
        all.push_back(std::nextafter(value, -1e9));
        all.push_back(std::nextafter(value, 1e9));
        all.push_back(value + 0.5);
    }
    for (const double end : {sorted.front(), sorted.back()})
        all.insert(all.end(), {end, end - 1, end + 1, std::nextafter(end, -1e9)});
    return all;
}

void expect_exact(const CellSeries& series, int n = 16) {
    const CellTier tier = series.tier();
    const std::vector<double> all = isovalues(series.values, n);
    for (std::uint32_t step = 0; step < series.values.steps; ++step) {
        const BruteForce oracle(series.values, step);
        for (const double isovalue : all)
            ASSERT_EQ(search(tier, series, step, isovalue), oracle.active(isovalue))
                << "step " << step << ", isovalue " << isovalue;
    }
}

void expect_exact(const TestField& field, int n = 16) {
    expect_exact({field.view(), lossless_map(field.view())}, n);
}

TEST(CellTier, IsExactOnASphere) {
    expect_exact(TestField({45, 40, 41}, 12, ValueType::u8, moving_sphere));
}

TEST(CellTier, IsExactOnTurbulence) {
    std::mt19937 random(test_seed());
    const auto function = turbulence(random);
    expect_exact(TestField({20, 17, 13}, 9, ValueType::u8, scaled(function, 250, 127)));
    expect_exact(TestField({20, 17, 13}, 9, ValueType::i8, scaled(function, 250, 0)));
    expect_exact(TestField({20, 17, 13}, 5, ValueType::u16, scaled(function, 120, 40000)));
    expect_exact(TestField({20, 17, 13}, 5, ValueType::i16, scaled(function, 120, -10)));
    expect_exact(TestField({20, 17, 13}, 5, ValueType::i32, scaled(function, 120, -1000000)));
}

TEST(CellTier, IsExactOnWhiteNoise) {
    std::mt19937 random(test_seed());
    const auto function = white_noise(random);
    expect_exact(TestField({23, 19, 11}, 7, ValueType::u8, scaled(function, 127, 128)));
    expect_exact(TestField({9, 8, 7}, 5, ValueType::u8, scaled(function, 1, 1)));
}

TEST(CellTier, IsExactOnFloatsOfFewValues) {
    std::mt19937 random(test_seed());
    const auto function = turbulence(random);
    const auto coarse = [&](double x, double y, double z, double t) {
        return std::round(40 * function(x, y, z, t)) / 7;
    };
    expect_exact(TestField({19, 18, 7}, 6, ValueType::f32, coarse));
    expect_exact(TestField({19, 18, 7}, 6, ValueType::f64, coarse));
}

TEST(CellTier, IsExactUnderFallingAndStretchedScalings) {
    std::mt19937 random(test_seed());
    const auto function = scaled(turbulence(random), 250, 127);
    expect_exact(TestField({14, 13, 12}, 5, ValueType::u8, function, {-0.25, 100}));
    expect_exact(TestField({14, 13, 12}, 5, ValueType::i8, function, {1e-3, -7}));
}

TEST(CellTier, IsExactWithTheVolumeForLossyMaps) {
    std::mt19937 random(test_seed());
    const auto function = turbulence(random);
    for (const ValueType type : {ValueType::f32, ValueType::f64, ValueType::u16, ValueType::u8})
        for (const std::size_t levels : {2, 5, 64, 256}) {
            const TestField field({16, 15, 14}, 5, type, scaled(function, 250, 127));
            expect_exact({field.view(), lossy_map(field.view(), levels)});
        }
    const TestField field({7, 6, 5}, 3, ValueType::f32, function);
    expect_exact({field.view(), LevelMap::of_thresholds(ValueType::f32, {})});
}

TEST(CellTier, LeavesNothingOpenAtTheThresholds) {
    std::mt19937 random(test_seed());
    const TestField field({16, 15, 14}, 5, ValueType::f32, turbulence(random));
    const CellSeries series(field.view(), lossy_map(field.view(), 64));
    const CellTier tier = series.tier();
    for (const std::uint64_t threshold : series.map.thresholds()) {
        const double isovalue = from_ordinal<float>(static_cast<std::uint32_t>(threshold));
        std::vector<IdRun> certain, ambiguous;
        tier.search(2, series.cut(isovalue).value(), certain, ambiguous);
        EXPECT_TRUE(ambiguous.empty());
        EXPECT_EQ(sorted_ids(certain), BruteForce(field.view(), 2).active(isovalue));
    }
}

TEST(CellTier, NeverReturnsCellsWithANaN) {
    std::mt19937 random(test_seed());
    const auto function = turbulence(random);
    const auto coarse = [&](double x, double y, double z, double t) {
        return std::round(40 * function(x, y, z, t));
    };
    TestField field({14, 13, 12}, 8, ValueType::f32, coarse);
    const std::size_t vertices = field.view().grid.vertex_count();
    for (int i = 0; i < 200; ++i)
        field.at<float>(random() % 7, random() % vertices) =
            std::numeric_limits<float>::quiet_NaN();
    for (std::size_t i = 0; i < vertices; ++i)
        field.at<float>(3, i) = std::numeric_limits<float>::quiet_NaN();
    expect_exact(field);
    expect_exact({field.view(), lossy_map(field.view(), 20)});
}

TEST(CellTier, WorksOnAnyNumberOfSteps) {
    for (const std::size_t steps : {1, 2, 3, 7, 13, 31, 64})
        expect_exact(TestField({12, 11, 10}, steps, ValueType::u8,
                               [](double x, double y, double z, double t) {
                                   return moving_sphere(x + 16, y + 15, z + 18, t);
                               }),
                     8);
}

TEST(CellTier, WorksOnThinGrids) {
    std::mt19937 random(test_seed());
    const auto function = scaled(turbulence(random), 250, 127);
    for (const std::array<std::uint32_t, 3> vertices : {std::array<std::uint32_t, 3>{2, 2, 2},
                                                        {2, 2, 90},
                                                        {2, 90, 2},
                                                        {90, 2, 2},
                                                        {2, 30, 40},
                                                        {30, 2, 40},
                                                        {30, 40, 2}})
        expect_exact(TestField(vertices, 5, ValueType::u8, function));
}

TEST(CellTier, WorksOnManyStretches) {
    std::mt19937 random(test_seed());
    const TestField field({301, 61, 12}, 3, ValueType::u8, scaled(turbulence(random), 250, 127));
    ASSERT_GE(Stretches(field.view().grid).count(), 4u);
    expect_exact(field, 6);
    // Rows of as many cells as a stretch may have.
    const TestField rows({65536, 3, 2}, 2, ValueType::u8, scaled(turbulence(random), 250, 127));
    ASSERT_EQ(Stretches(rows.view().grid).count(), 2u);
    expect_exact(rows, 6);
}

TEST(CellTier, WorksWhereAllCellsOfAStretchAreAlike) {
    // 257 x 255 cells are 65,535: as many as a stretch may have, all of them active.
    const auto slope = [](double, double, double z, double) { return 100 + 50 * z; };
    const TestField field({258, 256, 2}, 3, ValueType::u8, slope);
    ASSERT_EQ(Stretches(field.view().grid).cells(0), 65535u);
    const CellSeries series(field.view(), LevelMap::of_type(ValueType::u8));
    EXPECT_EQ(search(series.tier(), series, 1, 120).size(), 65535u);
    expect_exact(series, 4);
    const auto noise = [](double x, double y, double z, double t) {
        return 100 + 50 * z + std::fmod(x * 7 + y * 3 + t * 11, 40);
    };
    expect_exact(TestField({258, 256, 2}, 2, ValueType::u8, noise), 6);
}

TEST(CellTier, FindsNothingInAConstantField) {
    const TestField field({9, 8, 7}, 5, ValueType::u8,
                          [](double, double, double, double) { return 77; });
    expect_exact(field);
    const CellSeries series(field.view(), LevelMap::of_type(ValueType::u8));
    EXPECT_EQ(series.cells.front().size(), 32u + 9 * 16 + 64); // no tables
}

TEST(CellTier, WorksAcrossEpochs) {
    const TestField field({7, 6, 5}, 600, ValueType::u8,
                          [](double x, double y, double z, double t) {
                              return 127 + 120 * std::sin(0.3 * x + 0.2 * y + 0.1 * z + 0.02 * t);
                          });
    expect_exact(field, 6);
}

TEST(CellTier, MayBeSearchedByManyThreadsAtOnce) {
    const TestField field({45, 40, 41}, 12, ValueType::u8, moving_sphere);
    const CellSeries series(field.view(), LevelMap::of_type(ValueType::u8));
    const CellTier tier = series.tier(); // nothing of it is checked yet
    std::vector<std::thread> threads;
    for (int thread = 0; thread < 4; ++thread)
        threads.emplace_back([&] {
            for (std::uint32_t step = 0; step < 12; ++step)
                EXPECT_EQ(search(tier, series, step, 112.5),
                          BruteForce(field.view(), step).active(112.5));
        });
    for (std::thread& thread : threads)
        thread.join();
}

} // namespace
} // namespace isochron::index
