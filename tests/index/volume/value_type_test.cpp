// What is known of the types of values, and in how many digits values are said.
#include "index/volume/value_type.h"

#include <gtest/gtest.h>

#include <limits>

namespace isochron::index {
namespace {

TEST(TellingDigits, TellTheValuesOfARangeApartToAThousandth) {
    EXPECT_EQ(telling_digits(101316.3, 101326.66), 8) << "to 0.01 of 10";
    EXPECT_EQ(telling_digits(99960.6, 102725), 6);
    EXPECT_EQ(telling_digits(-101326.66, -101316.3), 8);
    EXPECT_EQ(telling_digits(0.005, 41.3), kFewestDigits) << "as few as are usual";
    EXPECT_EQ(telling_digits(1e6, 1e6 + 1e-9), 12) << "no more than a person reads";
}

TEST(TellingDigits, AreTheUsualOnesOfARangeThatTellsNothing) {
    constexpr double kLargest = std::numeric_limits<double>::max();
    EXPECT_EQ(telling_digits(7, 7), kFewestDigits);
    EXPECT_EQ(telling_digits(0, 0), kFewestDigits);
    EXPECT_EQ(telling_digits(-kLargest, kLargest), kFewestDigits);
}

} // namespace
} // namespace isochron::index
