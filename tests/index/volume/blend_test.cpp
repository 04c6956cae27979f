// Blended values against exact fractions.
#include "index/volume/blend.h"
#include "index/volume/instant.h"
#include "tests/support/paths.h"
#include "tests/support/test_field.h"
#include "tests/support/test_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>
#include <string>

namespace isochron::index {
namespace {

constexpr std::uint32_t kN = Instant::kFractions;

/// Numbers of all sizes, many of them near each other, with few bits, or special.
class SomeNumbers {
  public:
    explicit SomeNumbers(std::uint32_t seed) : random_(seed) {}

    std::uint32_t below(std::uint32_t end) {
        return std::uniform_int_distribution<std::uint32_t>(0, end - 1)(random_);
    }
    double any() {
        const std::uint64_t bits = random_();
        switch (below(8)) {
        case 0: return std::bit_cast<double>(bits); // any at all
        case 1: return static_cast<double>(below(512)) - 256;
        case 2: return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
        case 3: return std::ldexp(1.0, static_cast<int>(below(2098)) - 1074) * sign();
        case 4: return sign() * 0x1.fffffffffffffp1023;
        case 5:
            return std::ldexp(static_cast<double>(bits >> 11), -1074) *
                   sign(); // subnormal, or nearly
        case 6: return below(2) ? 0.0 : -0.0;
        default: return std::generate_canonical<double, 53>(random_) * sign();
        }
    }
    double near(double value) {
        switch (below(6)) {
        case 0: return value;
        case 1: return -value;
        case 2: return std::nextafter(value, sign() * kInfinity);
        case 3: return value * (1 + std::ldexp(sign(), -static_cast<int>(below(60))));
        case 4: return value * std::ldexp(sign(), -static_cast<int>(below(120)));
        default: return any();
        }
    }
    /// Many of them leave sums with few bits.
    std::uint32_t fraction() { return below(3) == 0 ? 1u << below(16) : 1 + below(kN - 1); }

  private:
    double sign() { return below(2) ? 1.0 : -1.0; }
    std::mt19937_64 random_;
};

/// Has Python compare each line with exact fractions. @return its exit status
int python_says(const std::filesystem::path& folder, const std::string& lines) {
    std::ofstream(folder / "cases") << lines;
    std::ofstream(folder / "check.py") << R"(
import math, sys
from fractions import Fraction
N = 65536
wrong = checked = 0
for line in open(sys.argv[1]):
    a, b, n, low, v, above = line.split()
    a, b, low, v = map(float.fromhex, (a, b, low, v))
    if not (math.isfinite(a) and math.isfinite(b)):
        right = math.isnan(low)
    else:
        n = int(n)
        exact = (N - n) * Fraction(a) + n * Fraction(b)
        next = math.nextafter(low, math.inf)
        right = N * Fraction(low) <= exact and (math.isinf(next) or exact < N * Fraction(next))
        right = right and (exact >= N * Fraction(v)) == bool(int(above))
    checked += 1
    wrong += not right
    if not right:
        print('wrong:', line.strip())
print(checked, 'checked')
sys.exit(wrong > 0 or checked == 0)
)";
    const std::string command = fmt::format("python3 '{}' '{}'", (folder / "check.py").string(),
                                            (folder / "cases").string());
    return std::system(command.c_str());
}

std::string line_of(double a, double b, std::uint32_t n, double low, double isovalue) {
    return fmt::format("{:a} {:a} {} {:a} {:a} {}\n", a, b, n, low, isovalue,
                       low >= isovalue ? 1 : 0);
}

TEST(Blend, ABlendedNumberIsAtAnIsovalueOrAboveJustWhereTheExactFractionIs) {
    SomeNumbers some(test_seed());
    const test_support::TestFolder folder;
    std::string lines;
    for (int i = 0; i < tries(40000); ++i) {
        const double a = some.any(), b = some.near(a);
        const std::uint32_t n = some.fraction();
        const double low = blended(a, b, n);
        double isovalue = std::isfinite(low) ? low : 1.0;
        if (const std::uint32_t next = some.below(3))
            isovalue = std::nextafter(isovalue, next == 1 ? kInfinity : -kInfinity);
        if (!std::isfinite(isovalue))
            isovalue = 0;
        lines += line_of(a, b, n, low, isovalue);
    }
    EXPECT_EQ(python_says(folder.path(), lines), 0);
}

class BlendOfType : public testing::TestWithParam<std::tuple<ValueType, Scaling>> {};

TEST_P(BlendOfType, WholeArraysAreBlendedAsSingleNumbersAre) {
    const auto [type, scaling] = GetParam();
    SomeNumbers some(test_seed());
    const test_support::TestFolder folder;
    std::string lines;
    visit_value_type(type, [&, &type = type, &scaling = scaling]<class T>(std::type_identity<T>) {
        for (int round = 0; round < 40; ++round) {
            const std::uint32_t n = some.fraction();
            const Blend blend(type, scaling, n);
            // Not a multiple of any vector.
            std::vector<T> a(37), b(37);
            for (std::size_t i = 0; i < a.size(); ++i) {
                if constexpr (std::is_floating_point_v<T>) {
                    a[i] = static_cast<T>(some.any());
                    b[i] = static_cast<T>(some.near(static_cast<double>(a[i])));
                } else {
                    a[i] = static_cast<T>(some.below(0xffffffff));
                    b[i] = some.below(4) == 0 ? a[i] : static_cast<T>(some.below(0xffffffff));
                    if (some.below(8) == 0)
                        a[i] = std::numeric_limits<T>::lowest();
                    if (some.below(8) == 0)
                        b[i] = std::numeric_limits<T>::max();
                }
            }
            std::vector<double> memory(a.size());
            blend(std::as_bytes(std::span(a)), std::as_bytes(std::span(b)),
                  reinterpret_cast<std::byte*>(memory.data()));
            for (std::size_t i = 0; i < a.size(); ++i) {
                const double scaled_a = scaling(static_cast<double>(a[i])),
                             scaled_b = scaling(static_cast<double>(b[i])),
                             expected = blended(scaled_a, scaled_b, n);
                double found = memory[i];
                if (blend.type() == ValueType::i32)
                    found =
                        blend.scaling()(reinterpret_cast<const std::int32_t*>(memory.data())[i]);
                if (std::isnan(expected))
                    EXPECT_TRUE(std::isnan(found));
                else
                    EXPECT_EQ(found, expected) << scaled_a << ' ' << scaled_b << ' ' << n;
                lines += line_of(scaled_a, scaled_b, n, found, std::isfinite(found) ? found : 0.0);
            }
        }
    });
    EXPECT_EQ(python_says(folder.path(), lines), 0);
}

INSTANTIATE_TEST_SUITE_P(Types, BlendOfType,
                         testing::Combine(testing::ValuesIn(kAllTypes),
                                          testing::ValuesIn(kScalings)),
                         [](const auto& of) {
                             return fmt::format("{}_{}", name_of(std::get<0>(of.param)), of.index);
                         });

TEST(Blend, EqualValuesStayTheSame) {
    SomeNumbers some(test_seed());
    for (int i = 0; i < 10000; ++i) {
        const double value = some.any();
        if (!std::isfinite(value))
            continue;
        EXPECT_EQ(blended(value, value, some.fraction()), value);
    }
}

TEST(Blend, GrowsWithBothOfItsValues) {
    SomeNumbers some(test_seed());
    for (int i = 0; i < 10000; ++i) {
        double a = some.any(), more_a = some.near(a), b = some.any(), more_b = some.near(b);
        if (!std::isfinite(a) || !std::isfinite(b) || !std::isfinite(more_a) ||
            !std::isfinite(more_b))
            continue;
        if (more_a < a)
            std::swap(a, more_a);
        if (more_b < b)
            std::swap(b, more_b);
        const std::uint32_t n = some.fraction();
        EXPECT_LE(blended(a, b, n), blended(more_a, more_b, n));
    }
}

} // namespace
} // namespace isochron::index
