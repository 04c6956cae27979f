// Times in other units, from other dates, in every calendar.
#include "index/volume/instant_text.h"
#include "index/volume/time_unit.h"

#include <gtest/gtest.h>

#include <array>

namespace isochron::index {
namespace {

/// Time 0 of one unit as the time in another.
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
    EXPECT_EQ(from_february_to_march("julian", "1900"), 2);
    EXPECT_EQ(from_february_to_march("proleptic_gregorian", "1500"), 1);
    EXPECT_EQ(from_february_to_march("standard", "1500"), 2);
    EXPECT_EQ(zero_in("days since 1582-10-04", "days since 1582-10-15"), 1);
    EXPECT_EQ(zero_in("days since 2000-01-01", "weeks since 2000-01-08 (proleptic_gregorian)"), 7);
    EXPECT_EQ(times_in("days since 2000-01-01 (360_day)", "months since 2000-01-01 (360_day)", {2}),
              std::vector<double>{60});
    EXPECT_FALSE(zero_in("days since 2000-01-01", "days since 2000-01-02 (noleap)"));
}

/// Dates and what is between them are counted by hand from the calendars' months.
TEST(TimeUnit, OfMonthsFollowsTheCalendar) {
    struct Row {
        const char *unit, *calendar;
        double time;
        const char* date;
    };
    for (const Row& row : {
             Row{"months since 1979-01-01", "standard", 1, "1979-02-01"},
             Row{"months since 1979-01-01", "standard", 12, "1980-01-01"},
             Row{"months since 1979-01-01", "standard", 13.5, "1980-02-15 12:00"}, // a month of 29 days
             Row{"months since 1979-01-01", "standard", -1, "1978-12-01"},
             Row{"months since 1979-01-01", "standard", -0.5, "1978-12-16 12:00"},
             Row{"month since 2000-01-31 06:00", "standard", 1, "2000-02-29 06:00"},
             Row{"months since 2001-01-31", "noleap", 1, "2001-02-28 (noleap)"},
             Row{"months since 2000-01-01", "noleap", 2, "2000-03-01 (noleap)"},
             Row{"months since 2001-01-01", "all_leap", 1.5, "2001-02-15 12:00 (all_leap)"},
             Row{"months since 1000-01-01", "julian", 24, "1002-01-01 (julian)"},
             Row{"months since 1000-01-01", "proleptic_gregorian", 24,
                 "1002-01-01 (proleptic_gregorian)"},
             Row{"months since 1582-09-01", "standard", 2, "1582-11-01"},
             Row{"months since 2000-01-01", "360_day", 2.5, "2000-03-16 (360_day)"},
             Row{"months since 2000-01-01", "THIRTY_DAY_MONTHS", 2.5, "2000-03-16 (360_day)"},
             Row{"years since 1999-03-01", "standard", 1, "2000-03-01"},
             Row{"years since 1999-03-01", "standard", 0.5, "1999-08-31"}, // 183 of 366 days
             Row{"year since 2000-02-29", "standard", 1, "2001-02-28"},
             Row{"years since 1999-01-01", "noleap", 2, "2001-01-01 (noleap)"},
             Row{"years since 1999-01-01", "360_day", 0.5, "1999-07-01 (360_day)"},
             Row{"common_years since 1999-01-01", "standard", 2, "2000-12-31"},
         }) {
        const std::string unit = with_calendar(row.unit, row.calendar);
        EXPECT_EQ(time_text(std::array{row.time}, 0, unit), row.date) << unit << " " << row.time;
    }
    EXPECT_EQ(times_in("days since 1979-01-01", "months since 1979-01-01", {0, 1, 2, 12.5}),
              (std::vector<double>{0, 31, 59, 380.5}));
    EXPECT_EQ(times_in("hours since 1979-01-01 12:00", "years since 1979-01-01 06:00", {0, 1}),
              (std::vector<double>{-6, 8754}));
    EXPECT_EQ(times_in("months since 1979-01-01", "months since 1980-03-01", {0, 1.5}),
              (std::vector<double>{14, 15.5}));
    EXPECT_EQ(times_in("months since 1979-01-01", "years since 1980-01-01", {-1, 0.5}),
              (std::vector<double>{0, 18}));
    EXPECT_FALSE(zero_in("months since 1979-01-01", "days since 1979-01-01"));
    EXPECT_FALSE(zero_in("months since 1979-01-01", "months since 1979-02-02"));
}

TEST(TimeUnit, ThatIsNotSureIsNotGuessed) {
    for (const char* unit :
         {"days since 1582-10-10", "days since 0000-01-01", "days since 2000-13-01",
          "days since 2000-02-30", "days since 2000-01-32", "days since yesterday",
          "days since 2000-01-01 noon", "days", "", "days since 100000-01-01"}) {
        EXPECT_FALSE(zero_in("days since 2000-01-01", unit)) << unit;
        EXPECT_FALSE(zero_in(unit, "days since 2000-01-01")) << unit;
    }
    EXPECT_FALSE(zero_in("s since 2000-01-01", "s since 2000-01-01 " + std::string(1 << 20, '0')));
}

struct KnownDate {
    const char *unit, *calendar;
    double time;
    std::string date;
};
/// What cftime 1.6 makes of them.
const KnownDate kDates[]{
    {"hours since 1970-01-01 00:00:00", "standard", 347921.5, "2009-09-09 17:30:00"},
    {"hours since 1970-01-01 00:00:00", "standard", 577736.25, "2035-11-28 08:15:00"},
    {"hours since 1970-01-01 00:00:00", "standard", -1234.0, "1969-11-10 14:00:00"},
    {"days since 0001-01-01", "standard", 347921.5, "0953-07-23 12:00:00"},
    {"days since 0001-01-01", "standard", 577736.25, "1582-10-04 06:00:00"},
    {"seconds since 1582-10-04 23:59:59", "standard", 347921.5, "1582-10-19 00:38:40"},
    {"seconds since 1582-10-04 23:59:59", "standard", 577736.25, "1582-10-21 16:28:55"},
    {"seconds since 1582-10-04 23:59:59", "standard", -1234.0, "1582-10-04 23:39:25"},
    {"minutes since 2000-02-29 12:00", "standard", 347921.5, "2000-10-28 02:41:30"},
    {"minutes since 2000-02-29 12:00", "standard", 577736.25, "2001-04-05 16:56:15"},
    {"minutes since 2000-02-29 12:00", "standard", -1234.0, "2000-02-28 15:26:00"},
    {"hours since 1970-01-01 00:00:00", "proleptic_gregorian", 347921.5, "2009-09-09 17:30:00"},
    {"hours since 1970-01-01 00:00:00", "proleptic_gregorian", 577736.25, "2035-11-28 08:15:00"},
    {"hours since 1970-01-01 00:00:00", "proleptic_gregorian", -1234.0, "1969-11-10 14:00:00"},
    {"days since 0001-01-01", "proleptic_gregorian", 347921.5, "0953-07-30 12:00:00"},
    {"days since 0001-01-01", "proleptic_gregorian", 577736.25, "1582-10-16 06:00:00"},
    {"seconds since 1582-10-04 23:59:59", "proleptic_gregorian", 347921.5, "1582-10-09 00:38:40"},
    {"seconds since 1582-10-04 23:59:59", "proleptic_gregorian", 577736.25, "1582-10-11 16:28:55"},
    {"seconds since 1582-10-04 23:59:59", "proleptic_gregorian", -1234.0, "1582-10-04 23:39:25"},
    {"minutes since 2000-02-29 12:00", "proleptic_gregorian", 347921.5, "2000-10-28 02:41:30"},
    {"minutes since 2000-02-29 12:00", "proleptic_gregorian", 577736.25, "2001-04-05 16:56:15"},
    {"minutes since 2000-02-29 12:00", "proleptic_gregorian", -1234.0, "2000-02-28 15:26:00"},
    {"hours since 1970-01-01 00:00:00", "julian", 347921.5, "2009-09-09 17:30:00"},
    {"hours since 1970-01-01 00:00:00", "julian", 577736.25, "2035-11-28 08:15:00"},
    {"hours since 1970-01-01 00:00:00", "julian", -1234.0, "1969-11-10 14:00:00"},
    {"days since 0001-01-01", "julian", 347921.5, "0953-07-23 12:00:00"},
    {"days since 0001-01-01", "julian", 577736.25, "1582-10-04 06:00:00"},
    {"seconds since 1582-10-04 23:59:59", "julian", 347921.5, "1582-10-09 00:38:40"},
    {"seconds since 1582-10-04 23:59:59", "julian", 577736.25, "1582-10-11 16:28:55"},
    {"seconds since 1582-10-04 23:59:59", "julian", -1234.0, "1582-10-04 23:39:25"},
    {"minutes since 2000-02-29 12:00", "julian", 347921.5, "2000-10-28 02:41:30"},
    {"minutes since 2000-02-29 12:00", "julian", 577736.25, "2001-04-05 16:56:15"},
    {"minutes since 2000-02-29 12:00", "julian", -1234.0, "2000-02-28 15:26:00"},
    {"hours since 1970-01-01 00:00:00", "noleap", 347921.5, "2009-09-19 17:30:00"},
    {"hours since 1970-01-01 00:00:00", "noleap", 577736.25, "2035-12-14 08:15:00"},
    {"hours since 1970-01-01 00:00:00", "noleap", -1234.0, "1969-11-10 14:00:00"},
    {"days since 0001-01-01", "noleap", 347921.5, "0954-03-18 12:00:00"},
    {"days since 0001-01-01", "noleap", 577736.25, "1583-11-03 06:00:00"},
    {"seconds since 1582-10-04 23:59:59", "noleap", 347921.5, "1582-10-09 00:38:40"},
    {"seconds since 1582-10-04 23:59:59", "noleap", 577736.25, "1582-10-11 16:28:55"},
    {"seconds since 1582-10-04 23:59:59", "noleap", -1234.0, "1582-10-04 23:39:25"},
    {"minutes since 2000-02-28 12:00", "noleap", 347921.5, "2000-10-28 02:41:30"},
    {"minutes since 2000-02-28 12:00", "noleap", 577736.25, "2001-04-05 16:56:15"},
    {"minutes since 2000-02-28 12:00", "noleap", -1234.0, "2000-02-27 15:26:00"},
    {"hours since 1970-01-01 00:00:00", "all_leap", 347921.5, "2009-08-10 17:30:00"},
    {"hours since 1970-01-01 00:00:00", "all_leap", 577736.25, "2035-10-09 08:15:00"},
    {"hours since 1970-01-01 00:00:00", "all_leap", -1234.0, "1969-11-10 14:00:00"},
    {"days since 0001-01-01", "all_leap", 347921.5, "0951-08-09 12:00:00"},
    {"days since 0001-01-01", "all_leap", 577736.25, "1579-07-07 06:00:00"},
    {"seconds since 1582-10-04 23:59:59", "all_leap", 347921.5, "1582-10-09 00:38:40"},
    {"seconds since 1582-10-04 23:59:59", "all_leap", 577736.25, "1582-10-11 16:28:55"},
    {"seconds since 1582-10-04 23:59:59", "all_leap", -1234.0, "1582-10-04 23:39:25"},
    {"minutes since 2000-02-29 12:00", "all_leap", 347921.5, "2000-10-28 02:41:30"},
    {"minutes since 2000-02-29 12:00", "all_leap", 577736.25, "2001-04-04 16:56:15"},
    {"minutes since 2000-02-29 12:00", "all_leap", -1234.0, "2000-02-28 15:26:00"},
    {"hours since 1970-01-01 00:00:00", "360_day", 347921.5, "2010-04-07 17:30:00"},
    {"hours since 1970-01-01 00:00:00", "360_day", 577736.25, "2036-11-13 08:15:00"},
    {"hours since 1970-01-01 00:00:00", "360_day", -1234.0, "1969-11-09 14:00:00"},
    {"days since 0001-01-01", "360_day", 347921.5, "0967-06-12 12:00:00"},
    {"days since 0001-01-01", "360_day", 577736.25, "1605-10-27 06:00:00"},
    {"seconds since 1582-10-04 23:59:59", "360_day", 347921.5, "1582-10-09 00:38:40"},
    {"seconds since 1582-10-04 23:59:59", "360_day", 577736.25, "1582-10-11 16:28:55"},
    {"seconds since 1582-10-04 23:59:59", "360_day", -1234.0, "1582-10-04 23:39:25"},
    {"minutes since 2000-02-29 12:00", "360_day", 347921.5, "2000-11-01 02:41:30"},
    {"minutes since 2000-02-29 12:00", "360_day", 577736.25, "2001-04-10 16:56:15"},
    {"minutes since 2000-02-29 12:00", "360_day", -1234.0, "2000-02-28 15:26:00"},
};

TEST(TimeUnit, WithADateGivesTheDatesOfItsCalendar) {
    for (const KnownDate& known : kDates) {
        SCOPED_TRACE(std::string(known.unit) + " " + known.calendar);
        const std::string unit = with_calendar(known.unit, known.calendar);
        const std::string text = time_text(std::array{known.time}, 0, unit);
        const std::string date = text.substr(0, text.find(" ("));
        EXPECT_EQ(known.date.substr(0, date.size()), date.substr(0, known.date.size()));
        EXPECT_GE(date.size(), known.date.ends_with(" 00:00:00") ? 10u : 16u);
    }
    EXPECT_EQ(time_text(std::array{60.0}, 0, "days since 2000-01-01 (360_day)"),
              "2000-03-01 (360_day)");
    EXPECT_EQ(time_text(std::array{-1.0}, 0, "days since 0001-01-01"), "-1 days since 0001-01-01");
    EXPECT_EQ(time_text(std::array{1e300}, 0, "days since 2000-01-01"),
              "1e+300 days since 2000-01-01");
}

TEST(TimeUnit, TimesAreWrittenAsLongAsTellsThemApart) {
    const std::string hours = "hours since 1970-01-01 00:00:00";
    const std::array steps{347921.0, 347921.25, 347921.26, 347922.0};
    EXPECT_EQ(time_text(steps, 0, hours), "2009-09-09 17:00");
    EXPECT_EQ(time_text(steps, 1, hours), "2009-09-09 17:15:00");
    EXPECT_EQ(time_text(steps, 2, hours), "2009-09-09 17:15:36");
    const std::array daily{0.0, 24.0};
    EXPECT_EQ(time_text(daily, 1, hours), "1970-01-02");
    const std::array fast{0.0, 0.125};
    EXPECT_EQ(time_text(fast, 0, "s since 2000-01-01T12:00Z"), "2000-01-01 12:00:00.000");
    EXPECT_EQ(time_text(std::array{0.1, 0.2}, 0, "s"), "0.1 s");
    EXPECT_EQ(time_text(std::array{1234567.0, 1234567.5}, 0, ""), "1234567");
    EXPECT_EQ(time_text(std::array{1234567.0, 1234567.5}, 1, ""), "1234568");
}

TEST(TimeUnit, DatesBetweenStepsAreWrittenAsPeopleWriteThem) {
    const auto between = [](std::vector<double> times, double share, const std::string& unit) {
        const auto fraction = static_cast<std::uint32_t>(share * Instant::kFractions);
        return instant_text(times, {0, fraction}, unit);
    };
    const std::string hours = "hours since 1970-01-01 00:00:00";
    EXPECT_EQ(between({0, 1.0 / 6}, 0.8, hours), "1970-01-01 00:08");
    EXPECT_EQ(between({0, 1.0 / 6}, 1.0 / 3, hours), "1970-01-01 00:03:20");
    EXPECT_EQ(between({0, 24}, 1.0 / 3, hours), "1970-01-01 08:00");
    EXPECT_EQ(between({0, 1}, 1.0 / 3, "s since 1970-01-01"), "1970-01-01 00:00:00.333");
    EXPECT_EQ(between({0, 1}, 0.5, "s"), "0.5 s") << "no date";
}

TEST(TimeUnit, CalendarsAreNamedWhereTheyMakeADifference) {
    EXPECT_EQ(with_calendar("days since 2000-01-01", "Proleptic_Gregorian"),
              "days since 2000-01-01");
    EXPECT_EQ(with_calendar("days since 1000-01-01", "proleptic_gregorian"),
              "days since 1000-01-01 (proleptic_gregorian)");
    EXPECT_EQ(with_calendar("days since 2000-01-01", "gregorian"), "days since 2000-01-01");
    EXPECT_EQ(with_calendar("days since 2000-01-01", "noleap"), "days since 2000-01-01 (noleap)");
    EXPECT_EQ(with_calendar("s", ""), "s");
}

} // namespace
} // namespace isochron::index
