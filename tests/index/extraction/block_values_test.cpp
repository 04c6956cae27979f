// Values in volume blocks: none changes its side of an isovalue, for any type and scaling.
#include "index/extraction/block_values.h"
#include "index/volume/grid.h"
#include "tests/support/test_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace isochron::index {
namespace {

/// Held values of one type, as the GPU reads them: times the factor.
template <class T>
std::vector<float> units_of(const BlockValues& values, const std::vector<T>& stored,
                            const BlockLevels& levels) {
    std::vector<std::byte> held(stored.size() * size_of(values.held()));
    values.convert(reinterpret_cast<const std::byte*>(stored.data()), stored.size(), levels,
                   held.data());
    return visit_value_type(values.held(), [&]<class H>(std::type_identity<H>) {
        std::vector<float> units;
        for (std::size_t i = 0; i < stored.size(); ++i) {
            H value;
            std::memcpy(&value, held.data() + i * sizeof value, sizeof value);
            units.push_back(static_cast<float>(value) * values.factor());
        }
        return units;
    });
}

/// Every value is on its side of every isovalue, and so close to it as float can say.
template <class T>
void expect_sides(const std::vector<T>& stored, ValueType type, Scaling scaling,
                  const std::vector<double>& isovalues) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const T value : stored)
        if (std::isfinite(scaling(double(value)))) {
            low = std::min(low, scaling(double(value)));
            high = std::max(high, scaling(double(value)));
        }
    const BlockValues values(type, scaling, low, high);
    const BlockLevels levels = values.levels(isovalues);
    ASSERT_EQ(levels.units.size(), isovalues.size());
    const auto units = units_of(values, stored, levels);
    for (std::size_t i = 0; i < stored.size(); ++i) {
        const double scaled = scaling(double(stored[i]));
        if (std::isnan(scaled)) {
            ASSERT_TRUE(std::isnan(units[i]));
            continue;
        }
        for (std::size_t k = 0; k < isovalues.size(); ++k) {
            ASSERT_EQ(units[i] < levels.units[k], scaled < isovalues[k])
                << name_of(type) << ' ' << stored[i] << " at isovalue " << isovalues[k];
            ASSERT_EQ(units[i] - levels.units[k] < 0, scaled < isovalues[k]); // as a shader does it
        }
        ASSERT_LE(std::abs(units[i]),
                  std::isfinite(scaled) ? 4.01f : std::numeric_limits<float>::infinity());
    }
    // One unit for all: differences of values are differences of units.
    if (low < high) {
        const auto [least, most] = std::ranges::minmax_element(units);
        if (std::isfinite(*least) && std::isfinite(*most)) {
            EXPECT_NEAR((*most - *least) / values.range(), 1.0, 1e-4) << name_of(type);
        }
    }
}

TEST(BlockValues, KeepEveryValueOnItsSideForEveryTypeScalingAndIsovalue) {
    std::mt19937 random(test_seed());
    for (const ValueType type : kAllTypes)
        for (const Scaling scaling : {Scaling{1, 0}, Scaling{-0.25, 3}, Scaling{0.1, -7.3}})
            for (const double spread : {3.0, 100.0, 3e9}) {
                const TestField field({7, 7, 7}, 1, type, scaled(white_noise(random), spread, 10),
                                      scaling);
                visit_value_type(type, [&]<class T>(std::type_identity<T>) {
                    const auto step = field.view().step<T>(0);
                    const std::vector<T> stored(step.begin(), step.end());
                    std::vector<double> isovalues;
                    for (int i = 0; i < 4; ++i) { // on values, and anywhere
                        const T value = stored[random() % stored.size()];
                        isovalues.push_back(scaling(double(value)));
                        isovalues.push_back(scaling(double(value) + 0.3));
                    }
                    expect_sides(stored, type, scaling, isovalues);
                });
            }
}

TEST(BlockValues, TellApartWhatFloatCannot) {
    // Doubles closer to each other than floats: on, below and above isovalues as close.
    std::vector<double> stored, isovalues;
    for (int i = -40; i <= 40; ++i)
        stored.push_back(1000.0 + i * 1e-9);
    stored.insert(stored.end(), {-1000.0, 1000.0 + 1e-3, 5000.0});
    for (int i = -3; i <= 3; ++i)
        isovalues.push_back(1000.0 + i * 1e-9);
    isovalues.push_back(1000.0); // twice
    std::mt19937 random(test_seed());
    std::shuffle(isovalues.begin(), isovalues.end(), random);
    expect_sides(stored, ValueType::f64, {}, isovalues);
    const std::vector<std::int32_t> whole{2147483647, 2147483646,      2147483645,
                                          5,          -2147483647 - 1, -2147483647};
    expect_sides(whole, ValueType::i32, {},
                 {2147483646.5, 2147483646.0, 2147483645.5, 2147483647.0, -2147483647.0, 5.0});
}

TEST(BlockValues, HoldTheLimitsOfFloatingPoint) {
    const double most = std::numeric_limits<double>::max();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    expect_sides(std::vector{-most, most, 0.0, 1e300, -1e300, nan, infinity, -infinity},
                 ValueType::f64, {}, {0.0, 1e300, -1e299});
    const float widest = std::numeric_limits<float>::max();
    expect_sides(std::vector{-widest, widest, 0.0f, 1e30f, -1e37f}, ValueType::f32, {},
                 {0.0, 1e30, -1e36});
    expect_sides(std::vector{1e-30f, 2e-30f, 3e-30f}, ValueType::f32, {}, {2e-30, 1.5e-30});
    expect_sides(std::vector{4.0, 4.0}, ValueType::f64, {}, {4.0, 5.0}); // one value only
    expect_sides(std::vector<std::uint8_t>{0, 0}, ValueType::u8, {}, {});
}

TEST(BlockValues, ALevelLiesWhereTheIsovalueDoes) {
    // Between 3 and 4, not on 4: a surface would be drawn in another place.
    const BlockValues values(ValueType::u8, {}, 0, 255);
    const auto levels = values.levels(std::vector{3.25, 200.0});
    EXPECT_FLOAT_EQ(levels.units[0] / values.factor(), 3.25f);
    EXPECT_FLOAT_EQ(levels.units[1] / values.factor(), 200.0f);
    const BlockValues turned(ValueType::i16, {-0.5, 1}, -500, 500);
    EXPECT_FLOAT_EQ(turned.levels(std::vector{10.2}).units[0] / turned.factor(), -18.4f);
}

} // namespace
} // namespace isochron::index
