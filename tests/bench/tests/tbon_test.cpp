// The T-BON finds what brute force finds, on every kind of data.
#include "tests/bench/rivals/tbon.h"

#include "tests/support/test_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochron::bench {
namespace {

using index::BruteForce;
using index::CellId;
using index::StepValues;
using index::TestField;
using index::ValueType;

void expect_exact(const StepValues& values, const std::vector<double>& isovalues) {
    const Tbon tbon(values);
    for (std::uint32_t step = 0; step < values.steps; ++step) {
        const BruteForce oracle(values, step);
        for (const double isovalue : isovalues) {
            std::vector<CellId> found;
            tbon.search({step, isovalue}, found);
            std::sort(found.begin(), found.end());
            ASSERT_EQ(found, oracle.active(isovalue))
                << "step " << step << ", isovalue " << isovalue;
        }
    }
}

/// Values of the field, where ties are, and what lies between and beyond them.
std::vector<double> isovalues_of(const StepValues& values) {
    const auto sorted = index::sorted_values(values);
    std::vector<double> isovalues{-1e300, 1e300, std::numeric_limits<double>::quiet_NaN()};
    for (const double value : index::quantiles(sorted, 12))
        if (std::isfinite(value))
            isovalues.insert(isovalues.end(), {value, value + 0.25, std::nextafter(value, 1e300)});
    return isovalues;
}

TEST(Tbon, FindsTheActiveCellsOfTheMovingSphere) {
    for (const ValueType type : {ValueType::u8, ValueType::f32}) {
        const TestField field({61, 50, 60}, 6, type, index::moving_sphere);
        expect_exact(field.view(), index::quantiles(index::sorted_values(field.view()), 64));
    }
}

TEST(Tbon, HoldsForAllTypesAndExtents) {
    std::mt19937 random(test_seed());
    for (const ValueType type : {ValueType::i8, ValueType::u8, ValueType::i16, ValueType::u16,
                                 ValueType::i32, ValueType::f32, ValueType::f64})
        for (const std::array<std::uint32_t, 3> vertices : {std::array<std::uint32_t, 3>{2, 2, 2},
                                                            {3, 3, 3},
                                                            {4, 2, 9},
                                                            {2, 18, 3},
                                                            {17, 16, 15}}) {
            SCOPED_TRACE(testing::Message() << index::name_of(type) << ' ' << vertices[0] << ' '
                                            << vertices[1] << ' ' << vertices[2]);
            const TestField field(vertices, 3, type,
                                  index::scaled(index::turbulence(random), 90, 100));
            expect_exact(field.view(), isovalues_of(field.view()));
        }
}

TEST(Tbon, HoldsForScaledValuesAlsoWithAFallingScale) {
    std::mt19937 random(test_seed());
    for (const double slope : {0.37, -2.5}) {
        const TestField field({9, 12, 7}, 2, ValueType::i16,
                              index::scaled(index::turbulence(random), 400, 0), {slope, 11});
        expect_exact(field.view(), isovalues_of(field.view()));
    }
}

TEST(Tbon, LeavesOutCellsWithANanVertex) {
    std::mt19937 random(test_seed());
    const auto smooth = index::turbulence(random);
    for (const double special :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        const TestField field({13, 11, 8}, 3, ValueType::f32,
                              [&](double x, double y, double z, double t) {
                                  return random() % 40 == 0 ? special : smooth(x, y, z, t);
                              });
        expect_exact(field.view(), isovalues_of(field.view()));
    }
    const TestField nothing({4, 4, 4}, 1, ValueType::f32, [](double, double, double, double) {
        return std::numeric_limits<double>::quiet_NaN();
    });
    expect_exact(nothing.view(), {0, 1});
}

TEST(Tbon, StoresItsTopologyOnceAndTwoValuesPerNodeAndStep) {
    // 5 x 3 x 2 cells: 3 x 2 x 1 leaves, 2 x 1 x 1 above them, the root.
    const auto bytes = [](std::size_t steps, ValueType type) {
        const TestField field({6, 4, 3}, steps, type,
                              [](double x, double, double, double) { return x; });
        return Tbon(field.view()).bytes();
    };
    EXPECT_EQ(bytes(2, ValueType::u8) - bytes(1, ValueType::u8), 9u * 2);
    EXPECT_EQ(bytes(5, ValueType::f32) - bytes(1, ValueType::f32), 4u * 9 * 8);
}

} // namespace
} // namespace isochron::bench
