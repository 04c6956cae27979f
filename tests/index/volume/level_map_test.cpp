// Cuts by rank agree with comparisons of scaled values.
#include "index/volume/level_map.h"

#include "index/volume/ordinal.h"

#include "tests/support/test_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>

namespace isochron::index {
namespace {

template <class T>
std::vector<T> random_values(std::mt19937& random, std::size_t count) {
    std::vector<T> values;
    for (std::size_t i = 0; i < count; ++i)
        if constexpr (std::is_floating_point_v<T>)
            values.push_back(static_cast<T>(std::normal_distribution<double>(0, 100)(random)));
        else
            values.push_back(static_cast<T>(random()));
    return values;
}

template <class T>
std::vector<std::uint64_t> ordinals(const std::vector<T>& values) {
    std::set<std::uint64_t> distinct;
    for (const T value : values)
        distinct.insert(ordinal(value));
    return {distinct.begin(), distinct.end()};
}

/// Compares the side of every value with that of its scaled value, at isovalues on, between and
/// beyond the values. @return share of the cuts that were exact
template <class T>
double check_cuts(const LevelMap& levels, const std::vector<T>& values, const Scaling& scaling) {
    std::vector<std::uint8_t> ranks(values.size());
    levels.ranks(std::as_bytes(std::span(values)), ranks);
    std::vector<double> isovalues{-1e300, 1e300};
    for (const T value : values) {
        const double scaled = scaling(static_cast<double>(value));
        for (const double v :
             {scaled, std::nextafter(scaled, -1e308), std::nextafter(scaled, 1e308)})
            isovalues.push_back(v);
    }
    int exact = 0;
    for (const double v : isovalues) {
        const auto cut = levels.cut(scaling, v);
        std::size_t upper = 0;
        for (const T value : values)
            upper += scaling(static_cast<double>(value)) >= v;
        if (!cut) {
            EXPECT_TRUE(upper == 0 || upper == values.size()) << v;
            ++exact;
            continue;
        }
        exact += cut->exact;
        const bool rising = scaling.slope > 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            // The upper side of the cut is the lower one of a falling scaling.
            const bool side = (scaling(static_cast<double>(values[i])) >= v) == rising;
            if (cut->exact) {
                EXPECT_EQ(ranks[i] >= cut->threshold, side) << v;
            } else if (ranks[i] != cut->threshold) {
                EXPECT_EQ(ranks[i] > cut->threshold, side) << v;
            }
        }
    }
    return static_cast<double>(exact) / static_cast<double>(isovalues.size());
}

template <class T>
void check_type(ValueType type) {
    SCOPED_TRACE(name_of(type));
    std::mt19937 random(test_seed());
    for (const Scaling& scaling : {Scaling{}, Scaling{0.1, -3}, Scaling{-2.5, 7}}) {
        const std::vector<T> values = random_values<T>(random, 200);
        const std::vector<std::uint64_t> distinct = ordinals(values);
        if (sizeof(T) == 1) {
            EXPECT_EQ(check_cuts(LevelMap::of_type(type), values, scaling), 1);
        }
        EXPECT_EQ(check_cuts(LevelMap::of_values(type, distinct), values, scaling), 1);
        std::vector<std::uint64_t> some;
        for (std::size_t i = 0; i < distinct.size(); i += 7)
            some.push_back(distinct[i]);
        EXPECT_LT(check_cuts(LevelMap::of_thresholds(type, some), values, scaling), 1);
        check_cuts(LevelMap::of_thresholds(type, {}), values, scaling);
    }
    const std::vector<T> constant(5, T{3});
    EXPECT_EQ(check_cuts(LevelMap::of_values(type, ordinals(constant)), constant, {}), 1);
}

TEST(LevelMap, CutsAsScaledValuesDo) {
    check_type<std::int8_t>(ValueType::i8);
    check_type<std::uint8_t>(ValueType::u8);
    check_type<std::int16_t>(ValueType::i16);
    check_type<std::uint16_t>(ValueType::u16);
    check_type<std::int32_t>(ValueType::i32);
    check_type<float>(ValueType::f32);
    check_type<double>(ValueType::f64);
}

TEST(LevelMap, OfATypeHasARankForEveryValue) {
    const LevelMap levels = LevelMap::of_type(ValueType::i8);
    EXPECT_EQ(levels.levels(), 256u);
    EXPECT_TRUE(levels.lossless());
    const std::array<std::int8_t, 3> values{-128, 0, 127};
    std::array<std::uint8_t, 3> ranks{};
    levels.ranks(std::as_bytes(std::span(values)), ranks);
    EXPECT_EQ(ranks, (std::array<std::uint8_t, 3>{0, 128, 255}));
}

TEST(LevelMap, HasNoCutAtWhatIsNoNumber) {
    const LevelMap levels = LevelMap::of_type(ValueType::u8);
    for (const double v :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
          -std::numeric_limits<double>::infinity()})
        EXPECT_FALSE(levels.cut({}, v));
}

} // namespace
} // namespace isochron::index
