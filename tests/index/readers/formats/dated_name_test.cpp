// Dates in names of files and folders.
#include "index/readers/formats/series/dated_name.h"

#include <gmock/gmock.h>

namespace isochron::index {
namespace {

using testing::ElementsAre;

std::optional<NameDates> found_in(const std::vector<std::filesystem::path>& names) {
    return dates_in_names(names);
}

struct DatedNames {
    const char* what;
    std::vector<std::filesystem::path> names;
    std::vector<double> times; ///< empty: no dates
    bool days;
};

class DatesInNames : public testing::TestWithParam<DatedNames> {};

TEST_P(DatesInNames, AreDaysOrSecondsSinceTheEpoch) {
    const auto found = found_in(GetParam().names);
    ASSERT_EQ(found.has_value(), !GetParam().times.empty());
    EXPECT_EQ(note_on_dates(GetParam().names).has_value(), found && GetParam().names.size() > 1);
    if (!found)
        return;
    EXPECT_EQ(found->times, GetParam().times);
    EXPECT_EQ(found->unit, GetParam().days ? "days since 1970-01-01" : "seconds since 1970-01-01");
}

constexpr double kDay = 86'400;

INSTANTIATE_TEST_SUITE_P(
    , DatesInNames,
    testing::Values(
        DatedNames{"dashes", {"v_1970-01-02.vti", "v_1969-12-31.vti"}, {1, -1}, true},
        DatedNames{"points", {"1970.01.02.nc", "1970.03.01.nc"}, {1, 59}, true},
        DatedNames{"a_leap_day", {"2000_02_29", "2000_03_01"}, {11016, 11017}, true},
        DatedNames{"compact", {"ta_19700102.nc", "ta_19700201.nc"}, {1, 31}, true},
        DatedNames{"wrf",
                   {"wrfout_d01_1970-01-01_06:00:00", "wrfout_d01_1970-01-02_00:30:15"},
                   {6 * 3600, kDay + 1815},
                   false},
        DatedNames{"compact_with_minutes",
                   {"x19700101T0600Z.nc", "x19700102T0000Z.nc"},
                   {6 * 3600, kDay},
                   false},
        DatedNames{"compact_with_seconds",
                   {"x19700101_060001.nc", "x19700101_060002.nc"},
                   {21'601, 21'602},
                   false},
        DatedNames{"one_with_an_hour", {"a_1970-01-01", "a_1970-01-01T01"}, {0, 3600}, false},
        DatedNames{"folders", {"1970-01-02/p.vti", "1970-01-03/p.vti"}, {1, 2}, true},
        DatedNames{"the_date_that_differs",
                   {"run20200101/v_1970-01-02.nc", "run20200101/v_1970-01-05.nc"},
                   {1, 4},
                   true},
        DatedNames{"one_name", {"v_1970-01-11.vti"}, {10}, true},
        DatedNames{"numbers", {"t_00000001", "t_00000002"}, {}, true},
        DatedNames{"no_such_day", {"v_2019-02-29", "v_2019-03-01"}, {}, true},
        DatedNames{"beyond_the_years", {"v_12340101", "v_12340102"}, {}, true},
        DatedNames{"only_some", {"v_2019-02-28", "v_1"}, {}, true},
        DatedNames{"the_same", {"v_2019-02-28_a1", "v_2019-02-28_a2"}, {}, true},
        DatedNames{"nine_digits", {"v_202001011", "v_202001021"}, {}, true},
        DatedNames{"mixed_signs", {"v_2020-01_02", "v_2020-01_03"}, {}, true},
        DatedNames{"day_first", {"v_31-01-1970", "v_01-02-1970"}, {30, 31}, true},
        DatedNames{"month_first", {"v_01/31/1970", "v_02/01/1970"}, {30, 31}, true},
        DatedNames{"day_first_points", {"s_31.12.1969", "s_02.01.1970"}, {-1, 1}, true},
        DatedNames{"either_first", {"v_01-02-1970", "v_02-01-1970"}, {}, true},
        DatedNames{"both_first", {"v_31-01-1970", "v_01-31-1970"}, {}, true},
        DatedNames{"words", {"v_31Jan1970", "v_1feb1970"}, {30, 31}, true},
        DatedNames{"words_first", {"jan-31-1970.nc", "February-01-1970.nc"}, {30, 31}, true},
        DatedNames{"words_between", {"v-1970-jan-31", "v-1970-mar-01"}, {30, 59}, true},
        DatedNames{
            "months_of_years", {"v_feb1970", "v_jan_1971", "v_1971-mar"}, {31, 365, 424}, true},
        DatedNames{"parts_of_words", {"marble1970", "decay1971"}, {}, true}),
    [](const auto& test) { return test.param.what; });

TEST(DatesOfNames, OfTheDayHaveAnHourOnlyWhereOneStands) {
    // 24 is no hour, 60 no minute: the rest is no time of the day.
    EXPECT_THAT(found_in({"v_1970-01-01_24", "v_1970-01-02_24"})->times, ElementsAre(0, 1));
    EXPECT_THAT(found_in({"v_19700101_0160", "v_19700102_0160"})->times, ElementsAre(0, 1));
    EXPECT_THAT(found_in({"v_1970-01-01_1", "v_1970-01-02_1"})->times, ElementsAre(0, 1));
}

/// The order of names, where dates tell another than numbers do.
std::vector<std::size_t> order_among(const std::vector<std::string>& names) {
    return order_of_dates(names).order;
}

TEST(DatesOfNames, OrderThemWhereTheYearStandsLast) {
    EXPECT_THAT(order_among({"v_01-02-2020", "v_31-01-2020", "v_15-12-2019"}),
                ElementsAre(2, 1, 0));
    EXPECT_THAT(order_among({"01jan2021", "31dec2020"}), ElementsAre(1, 0));
    EXPECT_THAT(order_among({"v_2020-01-02", "v_2020-01-01"}), ElementsAre()) << "as their numbers";
    const std::vector<std::string> either{"v_02-01-2020", "v_01-02-2020"};
    EXPECT_THAT(order_of_dates(either, DayMonth::day_first).order, ElementsAre(0, 1));
    EXPECT_THAT(order_of_dates(either, DayMonth::month_first).order, ElementsAre(1, 0));
    const DateOrder open = order_of_dates(either);
    EXPECT_THAT(open.note, testing::HasSubstr("--dates dmy or --dates mdy"));
    EXPECT_THAT(open.order, ElementsAre());
    EXPECT_THAT(open.note, testing::HasSubstr("day-month-year or month-day-year"));
    EXPECT_THAT(order_of_dates({"v_02-02-2020", "v_03-03-2020"}).order, ElementsAre(0, 1))
        << "either reading";
}

} // namespace
} // namespace isochron::index
