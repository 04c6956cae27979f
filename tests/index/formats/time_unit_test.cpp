// Times in other units, from other dates, in every calendar.
#include "index/formats/time_unit.h"

#include <gtest/gtest.h>

namespace isochron::index {
namespace {

/// Of time 0 of one unit, the time in another.
std::optional<double> zero_in(const std::string& wanted, const std::string& given) {
    const auto times = times_in(wanted, given, {0});
    return times ? std::optional(times->front()) : std::nullopt;
}

TEST(TimeUnit, OfTheSameKindAreConverted) {
    EXPECT_EQ(times_in("s", "ms", {1500, 2000}), (std::vector<double>{1.5, 2}));
    EXPECT_EQ(times_in("fortnights", "fortnights", {3}), std::vector<double>{3});
    EXPECT_FALSE(times_in("s", "Hz", {1}));
    EXPECT_FALSE(times_in("s", "s since 2000-01-01", {1}));
}

TEST(TimeUnit, MayCountFromAnyDate) {
    EXPECT_EQ(zero_in("days since 1970-01-01", "s since 2000-03-01"), 11017);
    EXPECT_EQ(zero_in("hours since 1970-01-01 00:00:00", "days since 1969-12-31T18:30:00.0Z"),
              -5.5);
    EXPECT_EQ(zero_in("min since 2000-1-1", "min since 2000-1-1 0:0:30 UTC"), 0.5);
    EXPECT_EQ(zero_in("h since 2000-01-01 00:00 +01:00", "h since 2000-01-01"), 1);
    EXPECT_EQ(zero_in("h since 2000-01-01 00:00 -0530", "h since 2000-01-01"), -5.5);
}

TEST(TimeUnit, KeepsToItsCalendar) {
    const auto from_february_to_march = [](const std::string& calendar, const std::string& year) {
        return zero_in("days since " + year + "-02-28 (" + calendar + ")",
                       "days since " + year + "-03-01 (" + calendar + ")");
    };
    EXPECT_EQ(from_february_to_march("noleap", "2000"), 1);
    EXPECT_EQ(from_february_to_march("365_day", "0000"), 1);
    EXPECT_EQ(from_february_to_march("all_leap", "1999"), 2);
    EXPECT_EQ(from_february_to_march("366_day", "1999"), 2);
    EXPECT_EQ(from_february_to_march("360_day", "2000"), 3);
    EXPECT_EQ(zero_in("days since 0001-01-01 (360_day)", "days since 0002-01-01 (360_day)"), 360);
    EXPECT_FALSE(from_february_to_march("julian", "2000"));
    EXPECT_FALSE(zero_in("days since 2000-01-01", "days since 2000-01-02 (noleap)"));
}

TEST(TimeUnit, ThatIsNotSureIsNotGuessed) {
    for (const char* unit :
         {"days since 1500-01-01", "months since 2000-01-01", "days since 2000-13-01",
          "days since 2000-01-32", "days since yesterday", "days since 2000-01-01 noon", "days", "",
          "days since 99999-01-01"}) {
        EXPECT_FALSE(zero_in("days since 2000-01-01", unit)) << unit;
        EXPECT_FALSE(zero_in(unit, "days since 2000-01-01")) << unit;
    }
    EXPECT_FALSE(zero_in("s since 2000-01-01", "s since 2000-01-01 " + std::string(1 << 20, '0')));
}

} // namespace
} // namespace isochron::index
