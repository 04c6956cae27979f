// Numbers in names: one reading for files, folders of steps, groups and slices.
#include "index/readers/formats/open_series.h"
#include "index/readers/formats/series/numbered_name.h"
#include "tests/support/reader_fixtures.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace isochron::index {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> in_order(const std::vector<std::string>& names) {
    std::vector<std::string> sorted;
    for (const std::size_t i : read_names(names).order)
        sorted.push_back(names[i]);
    return sorted;
}

std::vector<double> numbers_in(const std::string& name) {
    std::vector<double> values;
    for (const NameNumber& number : taken_apart(name).numbers)
        values.push_back(number.value);
    return values;
}

struct NamesOfTimes {
    const char* what;
    std::vector<std::string> sorted;
};

class NamesInOrder : public testing::TestWithParam<NamesOfTimes> {};

TEST_P(NamesInOrder, WhateverOrderTheyAreGivenIn) {
    std::vector<std::string> names = GetParam().sorted;
    for (int turn = 0; turn < 4; ++turn) {
        EXPECT_EQ(in_order(names), GetParam().sorted);
        std::ranges::rotate(names, names.begin() + 1);
        std::ranges::reverse(names);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Of, NamesInOrder,
    testing::Values(
        NamesOfTimes{"decimals", {"t_0.1", "t_0.25", "t_0.5", "t_1", "t_1.5", "t_2", "t_10.5"}},
        NamesOfTimes{"files", {"t_0.25.vti", "t_0.5.vti", "t_1.vti", "t_1.25.vti"}},
        NamesOfTimes{"folders", {"r/0/p.vti", "r/0.5/p.vti", "r/1/p.vti", "r/1.25/p.vti"}},
        NamesOfTimes{"all_zeros_written", {"t0.000", "t0.125", "t0.500", "t1.000", "t10.250"}},
        NamesOfTimes{"python", {"t_0.0", "t_0.25", "t_0.5", "t_1.0", "t_10.0"}},
        NamesOfTimes{"leading_zeros", {"t_000.5", "t_00001", "t_001.5", "t_010.5", "t_0100"}},
        NamesOfTimes{"small_steps", {"t_0.05", "t_0.1", "t_0.15", "t_0.2"}},
        NamesOfTimes{"signs", {"t_-10", "t_-1.5", "t_-1", "t_0", "t_+0.5", "t_2"}},
        NamesOfTimes{"equal_signs", {"T=-2K", "T=-0.5K", "T=1K"}},
        NamesOfTimes{"signs_behind_letters", {"z-2.vti", "z-0.5.vti", "z0.vti", "z1.vti"}},
        NamesOfTimes{"joined_by_minus", {"run-1.vti", "run-2.vti", "run-10.vti"}},
        NamesOfTimes{"exponents", {"t_0", "t_5e-05", "t_0.0001", "t_1e-3", "t_0.5", "t_1.5e+02"}},
        NamesOfTimes{"fortran", {"t1.0D-02", "t5.0D-01", "t1.0D+00"}},
        NamesOfTimes{"bare_exponents", {"t_5e2", "t_1e3", "t_2E3"}},
        NamesOfTimes{"decimal_commas", {"t_0,25", "t_0,5", "t_1", "t_1,75"}},
        NamesOfTimes{"versions", {"v1.2.3", "v1.2.10", "v1.10.1"}},
        NamesOfTimes{"versions_beside", {"v1.2.3_t0.25", "v1.2.3_t0.5", "v1.2.3_t1"}},
        NamesOfTimes{"counts", {"plane_1.8", "plane_1.9", "plane_1.10", "plane_1.11", "plane_2.1"}},
        NamesOfTimes{"parts", {"run.1.9", "run.1.10", "run.2.1"}},
        NamesOfTimes{"dates", {"w_2020-01-09_18:00", "w_2020-01-10_00:00", "w_2020-02-01_00:00"}},
        NamesOfTimes{"long_numbers", {"t99999999999999999998", "t99999999999999999999"}},
        NamesOfTimes{"months",
                     {"c_jan.raw", "c_feb.raw", "c_mar.raw", "c_apr.raw", "c_may.raw", "c_jun.raw",
                      "c_jul.raw", "c_aug.raw", "c_sep.raw", "c_oct.raw", "c_nov.raw",
                      "c_dec.raw"}},
        NamesOfTimes{"long_months", {"January", "February", "May", "August", "December"}},
        NamesOfTimes{"months_with_years", {"v_nov2019", "v_jan2020", "v_feb2020", "v_jan2021"}},
        NamesOfTimes{"days_first", {"v_31-12-2019", "v_01-01-2020", "v_15-01-2020"}},
        NamesOfTimes{"no_months", {"decay_1", "decay_2", "marble_1"}},
        NamesOfTimes{"words", {"a1e", "a1e3x", "a2e", "b"}}),
    [](const auto& each) { return each.param.what; });

TEST(NumbersInNames, AreWhatAPersonReads) {
    EXPECT_THAT(numbers_in("t_0.25.vti"), ElementsAre(0.25));
    EXPECT_THAT(numbers_in("run2_t_-1.5e-3s.h5"), ElementsAre(2, -1.5e-3, 5));
    EXPECT_THAT(numbers_in("v1.2.3"), ElementsAre(1, 2, 3));
    EXPECT_THAT(numbers_in("2020-01-02"), ElementsAre(2020, 1, 2));
    EXPECT_THAT(numbers_in("img_t0_z0.5um.tif"), ElementsAre(0, 0.5));
    EXPECT_THAT(numbers_in("a3e5f"), ElementsAre(3, 5)) << "of a checksum";
    EXPECT_THAT(numbers_in("t_1.ex2"), ElementsAre(1, 2));
    EXPECT_THAT(numbers_in("t_1e-400"), ElementsAre(0));
}

TEST(NumbersInNames, SayWhichReadingWasTakenWhereTheOtherGivesAnotherOrder) {
    EXPECT_THAT(read_names({"a/t_0.5", "a/t_0.25"}).note.value_or(""),
                HasSubstr("read as decimals: t_0.25 before t_0.5"));
    EXPECT_THAT(read_names({"1.10", "1.9"}).note.value_or(""),
                HasSubstr("not as decimals: 1.9 before 1.10"));
    EXPECT_THAT(read_names({"c_apr", "c_jan"}).note.value_or(""),
                HasSubstr("read as months: c_jan before c_apr"));
    EXPECT_THAT(read_names({"c_01-01-2020", "c_31-12-2019"}).note.value_or(""),
                HasSubstr("read as day-month-year: c_31-12-2019 before c_01-01-2020"));
    EXPECT_EQ(read_names({"t_1", "t_2"}).note, std::nullopt);
    EXPECT_EQ(read_names({"t_0.1", "t_0.2"}).note, std::nullopt) << "either reading";
}

/// Volumes of 2 x 2 x 2 bytes of one value, 'a', 'b', ... in the order of their names.
class NamedSteps : public testing::Test {
  protected:
    void write(const std::vector<std::string>& names) {
        char value = 'a';
        for (const std::string& name : names) {
            std::filesystem::create_directories((folder_.path() / name).parent_path());
            folder_.write(name,
                          "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n\n" +
                              std::string(8, value++));
        }
    }
    std::string values(VolumeSeries& series) {
        std::string all;
        for (std::size_t step = 0; step < series.info().steps(); ++step)
            all += static_cast<char>(values_of<std::uint8_t>(series, step).front());
        return all;
    }
    std::unique_ptr<VolumeSeries> open(const ReadOptions& options = {}) {
        return open_series({folder_.path()}, options);
    }

    TestFolder folder_;
};

TEST_F(NamedSteps, WithWholeNumbersAmongDecimalsAreOneSeriesOfAFolder) {
    write({"t_0.25.nrrd", "t_0.5.nrrd", "t_1.nrrd", "t_1.5.nrrd", "t_2.25.nrrd"});
    EXPECT_EQ(values(*open()), "abcde");
    EXPECT_THAT(open()->info().notes, Contains(HasSubstr("read as decimals")));
}

TEST_F(NamedSteps, InFoldersAreOneSeriesToo) {
    write({"0/p.nrrd", "0.5/p.nrrd", "1/p.nrrd", "1.25/p.nrrd", "10/p.nrrd"});
    EXPECT_EQ(values(*open()), "abcde");
}

TEST_F(NamedSteps, HaveTheTimesThatANoteAdvises) {
    write({"0/p.nrrd", "1/p.nrrd", "2/p.nrrd", "9/p.nrrd", "10/p.nrrd"});
    EXPECT_THAT(open()->info().notes, Contains(HasSubstr("--times-from-names")));
    ReadOptions options;
    options.times_from_names = true;
    EXPECT_THAT(open(options)->info().times, ElementsAre(0, 1, 2, 9, 10));
    EXPECT_EQ(values(*open(options)), "abcde");
}

TEST_F(NamedSteps, HaveTimesFromTheNumbersThatDiffer) {
    write({"t_-1e-1_v2.nrrd", "t_0_v2.nrrd", "t_0.25_v2.nrrd"});
    ReadOptions options;
    options.times_from_names = true;
    EXPECT_THAT(open(options)->info().times, ElementsAre(-0.1, 0, 0.25));
    EXPECT_EQ(values(*open(options)), "abc");
}

TEST_F(NamedSteps, HaveTheUnitBehindTheNumberThatDiffers) {
    ReadOptions options;
    options.times_from_names = true;
    write({"t_2ms.nrrd", "t_10ms.nrrd", "t_25ms.nrrd"});
    EXPECT_THAT(open(options)->info().times, ElementsAre(2, 10, 25));
    EXPECT_EQ(open(options)->info().time_unit, "ms");
    options.time_unit = "us";
    EXPECT_EQ(open(options)->info().time_unit, "us");
}

TEST_F(NamedSteps, AreEvenlySpacedAsFarAsTheirDigitsTell) {
    write({"t_0.33.nrrd", "t_0.67.nrrd", "t_1.00.nrrd"});
    EXPECT_THAT(open()->info().notes, IsEmpty());
}

} // namespace
} // namespace isochron::index
