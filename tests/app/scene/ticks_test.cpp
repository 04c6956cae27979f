// Ticks are round, inside their range, and printed without the digits that rounding leaves behind.
#include "app/scene/ticks.h"

#include "tests/support/test_seed.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

namespace isochron::app {
namespace {

using testing::ElementsAre;

std::vector<std::string> texts(double low, double high, int most) {
    const Ticks ticks = nice_ticks(low, high, most);
    std::vector<std::string> result;
    for (const double value : ticks.values)
        result.push_back(tick_text(value, ticks.step));
    return result;
}

TEST(Ticks, AreRoundNumbers) {
    EXPECT_THAT(texts(0, 10, 6), ElementsAre("0", "2", "4", "6", "8", "10"));
    EXPECT_THAT(texts(-0.31, 0.29, 7), ElementsAre("-0.3", "-0.2", "-0.1", "0.0", "0.1", "0.2"));
    EXPECT_THAT(texts(12, 950, 5), ElementsAre("200", "400", "600", "800"));
    EXPECT_THAT(texts(1e-9, 4e-9, 4), ElementsAre("1e-09", "2e-09", "3e-09", "4e-09"));
    EXPECT_THAT(texts(1e7, 3e7, 3), ElementsAre("1e+07", "2e+07", "3e+07"));
}

TEST(Ticks, OfAnyRangeAreInsideItAndNotTooMany) {
    std::mt19937 random(test_seed());
    std::uniform_real_distribution<double> exponent(-30, 30), share(-1, 1);
    for (int i = 0; i < 2000; ++i) {
        const double scale = std::pow(10.0, exponent(random));
        const double low = scale * share(random);
        const double high = low + std::abs(scale * share(random)) + 1e-6 * scale;
        const int most = 2 + static_cast<int>(random() % 9);
        const Ticks ticks = nice_ticks(low, high, most);
        ASSERT_LE(ticks.values.size(), static_cast<std::size_t>(most)) << low << ' ' << high;
        // At least one, since a step is at most five times the finest that could do.
        ASSERT_GE(ticks.values.size(), most > 5 ? 1u : 0u) << low << ' ' << high << ' ' << most;
        const double mantissa =
            ticks.step / std::pow(10.0, std::floor(std::log10(ticks.step) + 1e-9));
        ASSERT_TRUE(std::abs(mantissa - 1) < 1e-6 || std::abs(mantissa - 2) < 1e-6 ||
                    std::abs(mantissa - 5) < 1e-6)
            << mantissa;
        for (const double value : ticks.values) {
            ASSERT_GE(value, low - 1e-8 * ticks.step);
            ASSERT_LE(value, high + 1e-8 * ticks.step);
            ASSERT_NEAR(std::stod(tick_text(value, ticks.step)), value, 1e-3 * ticks.step);
        }
    }
}

TEST(Ticks, OfARangeThatIsNoneAreNone) {
    EXPECT_TRUE(nice_ticks(1, 1, 5).values.empty());
    EXPECT_TRUE(nice_ticks(2, 1, 5).values.empty());
    EXPECT_TRUE(nice_ticks(0, std::numeric_limits<double>::infinity(), 5).values.empty());
    EXPECT_TRUE(nice_ticks(0, std::nan(""), 5).values.empty());
    EXPECT_LE(nice_ticks(1e15, 1e15 + 0.25, 5).values.size(), 5u);
}

} // namespace
} // namespace isochron::app
