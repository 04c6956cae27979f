// Keys keep the order of values, and thresholds of keys agree exactly with isovalues.
#include "index/volume/order_key.h"

#include "tests/support/test_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace isochron::index {
namespace {

/// Values of all magnitudes and both signs, the limits and their neighbors.
template <class T>
std::vector<T> samples(std::mt19937& random) {
    using Limits = std::numeric_limits<T>;
    std::vector<T> all{T{0}, T{1}, Limits::lowest(), Limits::max()};
    if constexpr (std::is_floating_point_v<T>)
        all.insert(all.end(), {T{-0.0}, Limits::infinity(), -Limits::infinity(), Limits::min(),
                               -Limits::denorm_min(), Limits::denorm_min(), T(0.1), T{-3.5}});
    while (all.size() < 300) {
        T value;
        std::uint64_t bits = random() | std::uint64_t{random()} << 32;
        std::memcpy(&value, &bits, sizeof value);
        if (value == value)
            all.push_back(value);
        if constexpr (std::is_floating_point_v<T>)
            all.push_back(static_cast<T>(std::normal_distribution<double>(0, 100)(random)));
    }
    return all;
}

TEST(Ordinal, IsInTheOrderOfTheValuesAndLeadsBackToThem) {
    std::mt19937 random(test_seed());
    for (const ValueType type : kAllTypes)
        visit_value_type(type, [&]<class T>(std::type_identity<T>) {
            const std::vector<T> all = samples<T>(random);
            for (const T a : all) {
                EXPECT_EQ(from_ordinal<T>(ordinal(a)), a);
                EXPECT_LE(lowest_ordinal<T>(), ordinal(a));
                EXPECT_GE(highest_ordinal<T>(), ordinal(a));
                for (const T b : all)
                    ASSERT_EQ(ordinal(a) < ordinal(b), a < b)
                        << name_of(type) << ' ' << +a << ' ' << +b;
            }
        });
}

TEST(KeyMap, ComparesKeysExactlyAsScaledValues) {
    std::mt19937 random(test_seed());
    for (const ValueType type : kAllTypes)
        for (const Scaling& scaling : kScalings)
            visit_value_type(type, [&]<class T>(std::type_identity<T>) {
                const KeyMap keys(type, scaling);
                const std::vector<T> all = samples<T>(random);
                for (const T a : all) {
                    const double low = scaling(static_cast<double>(a));
                    EXPECT_LE(keys.value(keys.low_key(a)), low);
                    EXPECT_GE(keys.value(keys.high_key(a)), low);
                    if (type != ValueType::f64) {
                        EXPECT_EQ(keys.low_key(a), keys.high_key(a));
                        EXPECT_EQ(keys.value(keys.low_key(a)), low);
                    }
                    for (const T b : all)
                        if (scaling(static_cast<double>(a)) < scaling(static_cast<double>(b))) {
                            ASSERT_LE(keys.low_key(a), keys.low_key(b));
                            ASSERT_LE(keys.high_key(a), keys.high_key(b));
                            ASSERT_LT(keys.low_key(a), keys.high_key(b));
                        }
                }
            });
}

TEST(KeyMap, ThresholdsDecideWhatIsovaluesDecide) {
    std::mt19937 random(test_seed());
    for (const ValueType type : kAllTypes)
        for (const Scaling& scaling : kScalings)
            visit_value_type(type, [&]<class T>(std::type_identity<T>) {
                const KeyMap keys(type, scaling);
                const std::vector<T> all = samples<T>(random);
                std::vector<double> isovalues{0, 1e-320, 1e300, -1e300};
                for (const T a : all) {
                    const double value = scaling(static_cast<double>(a));
                    for (const double v :
                         {value, std::nextafter(value, -1e308), std::nextafter(value, 1e308)})
                        if (std::isfinite(v))
                            isovalues.push_back(v);
                }
                for (const double v : isovalues) {
                    const std::uint64_t threshold = keys.threshold(v);
                    for (const T a : all) {
                        const double value = scaling(static_cast<double>(a));
                        if (type == ValueType::f64) {
                            if (value < v)
                                ASSERT_LT(keys.low_key(a), threshold) << value << ' ' << v;
                            else
                                ASSERT_GE(keys.high_key(a), threshold) << value << ' ' << v;
                        } else {
                            ASSERT_EQ(keys.low_key(a) >= threshold, value >= v)
                                << name_of(type) << ' ' << value << ' ' << v;
                        }
                    }
                }
            });
}

TEST(KeyMap, BothZerosAreOneValue) {
    for (const double slope : {1.0, -2.0}) {
        const KeyMap f32(ValueType::f32, {slope, 0});
        EXPECT_EQ(f32.low_key(0.0f), f32.low_key(-0.0f));
        const KeyMap f64(ValueType::f64, {slope, 0});
        EXPECT_EQ(f64.low_key(0.0), f64.high_key(-0.0));
        EXPECT_EQ(f64.low_key(-0.0), f64.high_key(0.0));
    }
}

TEST(KeyMap, AThresholdThatNoValueReachesIsAboveAllKeys) {
    const KeyMap u8(ValueType::u8, {});
    EXPECT_EQ(u8.threshold(255), u8.high_key(std::uint8_t{255}));
    EXPECT_GT(u8.threshold(255.5), u8.high_key(std::uint8_t{255}));
    EXPECT_EQ(u8.threshold(-1), u8.low_key(std::uint8_t{0}));
    EXPECT_EQ(KeyMap(ValueType::i32, {}).threshold(1e10), std::uint64_t{1} << 32);
}

} // namespace
} // namespace isochron::index
