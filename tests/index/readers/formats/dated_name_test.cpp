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
    testing::Values(DatedNames{"dashes", {"v_1970-01-02.vti", "v_1969-12-31.vti"}, {1, -1}, true},
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
                    DatedNames{
                        "one_with_an_hour", {"a_1970-01-01", "a_1970-01-01T01"}, {0, 3600}, false},
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
                    DatedNames{"mixed_signs", {"v_2020-01_02", "v_2020-01_03"}, {}, true}),
    [](const auto& test) { return test.param.what; });

TEST(DatesOfNames, OfTheDayHaveAnHourOnlyWhereOneStands) {
    // 24 is no hour, 60 no minute: the rest is no time of the day.
    EXPECT_THAT(found_in({"v_1970-01-01_24", "v_1970-01-02_24"})->times, ElementsAre(0, 1));
    EXPECT_THAT(found_in({"v_19700101_0160", "v_19700102_0160"})->times, ElementsAre(0, 1));
    EXPECT_THAT(found_in({"v_1970-01-01_1", "v_1970-01-02_1"})->times, ElementsAre(0, 1));
}

} // namespace
} // namespace isochron::index
