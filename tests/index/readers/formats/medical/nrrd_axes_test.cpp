// Which axes of an NRRD file are space, time and components: their kinds decide.
#include "index/readers/formats/open_series.h"
#include "tests/support/reader_fixtures.h"

#include <gmock/gmock.h>

#include <cmath>

namespace isochron::index {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class NrrdAxesTest : public testing::Test {
  protected:
    /// 48 bytes that count from 0. @param sizes fastest first
    std::filesystem::path file(const std::string& sizes, const std::string& more) const {
        const auto count = std::count(sizes.begin(), sizes.end(), ' ') + 1;
        return folder_.write("a.nrrd",
                             "NRRD0005\ntype: uint8\ndimension: " + std::to_string(count) +
                                 "\nsizes: " + sizes + "\nencoding: raw\n" + more + "\n" +
                                 text_of(ramp<std::uint8_t>(48)));
    }
    std::string complaint(const std::string& sizes, const std::string& more,
                          const ReadOptions& options = {}) const {
        return error_of([&] { open_series({file(sizes, more)}, options); });
    }

    TestFolder folder_;
};

/// Every n-th of 48, from the first.
std::vector<std::uint8_t> every(std::uint8_t n, std::uint8_t first) {
    std::vector<std::uint8_t> values;
    for (unsigned v = first; v < 48; v += n)
        values.push_back(static_cast<std::uint8_t>(v));
    return values;
}

TEST_F(NrrdAxesTest, AListIsComponentsWhereverItLies) {
    for (const char* kind : {"list", "vector", "3-color", "RGB-color", "3-vector", "point"}) {
        ReadOptions options;
        const std::string first = std::string("kinds: ") + kind + " domain domain domain\n",
                          last = std::string("kinds: domain domain domain ") + kind + "\n";
        EXPECT_THAT(complaint("3 4 2 2", first),
                    AllOf(HasSubstr("has 3 components, choose one"),
                          HasSubstr("--extra-axis-is-time reads them as steps")));
        EXPECT_THAT(complaint("4 2 2 3", last), HasSubstr("has 3 components, choose one"));
        options.component = "1";
        auto series = open_series({file("3 4 2 2", first)}, options);
        EXPECT_EQ(series->info().grid.vertices, (std::array<std::uint32_t, 3>{4, 2, 2}));
        EXPECT_EQ(series->info().steps(), 1u);
        EXPECT_EQ(values_of<std::uint8_t>(*series, 0), every(3, 1)) << kind;
        series = open_series({file("4 2 2 3", last)}, options);
        EXPECT_EQ(series->info().steps(), 1u);
        EXPECT_EQ(series->info().array, "values.1");
        EXPECT_EQ(values_of<std::uint8_t>(*series, 0), ramp<std::uint8_t>(16, 16)) << kind;
        options.component = "magnitude";
        series = open_series({file("4 2 2 3", last)}, options);
        EXPECT_EQ(series->info().array, "values.magnitude");
        EXPECT_FLOAT_EQ(values_of<float>(*series, 0)[5], std::sqrt(5 * 5 + 21 * 21 + 37 * 37.f));
    }
}

TEST_F(NrrdAxesTest, AnAxisOfAnUnknownKindIsAskedFor) {
    for (const char* kind : {"???", "none"}) {
        const std::string first = std::string("kinds: ") + kind + " domain domain domain\n",
                          last = std::string("kinds: domain domain domain ") + kind + "\n";
        EXPECT_THAT(complaint("3 4 2 2", first),
                    AllOf(HasSubstr("axis 0, of 3"), HasSubstr(kind),
                          HasSubstr("--extra-axis-is-time"), HasSubstr("--component N")));
        EXPECT_THAT(complaint("4 2 2 3", last), HasSubstr("axis 3, of 3"));
        ReadOptions options;
        options.extra_axis_is_time = true;
        auto series = open_series({file("4 2 2 3", last)}, options);
        EXPECT_EQ(series->info().steps(), 3u);
        EXPECT_EQ(values_of<std::uint8_t>(*series, 2), ramp<std::uint8_t>(16, 32));
        options = {};
        options.component = "2";
        series = open_series({file("3 4 2 2", first)}, options);
        EXPECT_EQ(values_of<std::uint8_t>(*series, 0), every(3, 2));
    }
    EXPECT_THAT(complaint("2 2 4 3", "kinds: domain domain domain domain\n"),
                HasSubstr("axis 3, of 3"));
}

// As 3D Slicer writes a MultiVolume.
TEST_F(NrrdAxesTest, AListThatTheUserCallsTimeIsASeries) {
    ReadOptions options;
    options.extra_axis_is_time = true;
    const auto series =
        open_series({file("3 4 2 2", "kinds: list domain domain domain\n"
                                     "space: left-posterior-superior\n"
                                     "space directions: none (2,0,0) (0,2,0) (0,0,3)\n")},
                    options);
    EXPECT_EQ(series->info().array, "values");
    EXPECT_EQ(series->info().grid.spacing, glm::dvec3(2, 2, 3));
    ASSERT_EQ(series->info().steps(), 3u);
    for (const std::size_t step : {2, 0, 1})
        EXPECT_EQ(values_of<std::uint8_t>(*series, step),
                  every(3, static_cast<std::uint8_t>(step)));
}

TEST_F(NrrdAxesTest, TimeIsWhereAKindOrAUnitSaysSo) {
    auto series = open_series({file("4 2 2 3", "kinds: domain domain domain time\n"
                                               "spacings: 1 1 1 0.5\naxismins: 0 0 0 2\n")});
    EXPECT_EQ(series->info().times, (std::vector<double>{2, 2.5, 3}));
    EXPECT_THAT(series->info().notes, testing::IsEmpty());
    series =
        open_series({file("3 4 2 2", "kinds: time domain domain domain\n"
                                     "spacings: 0.5 1 2 1\nunits: \"s\" \"mm\" \"mm\" \"mm\"\n")});
    EXPECT_EQ(series->info().times, (std::vector<double>{0, 0.5, 1}));
    EXPECT_EQ(series->info().time_unit, "s");
    EXPECT_EQ(series->info().grid.spacing, glm::dvec3(1, 2, 1));
    EXPECT_EQ(values_of<std::uint8_t>(*series, 1), every(3, 1));
    series = open_series({file("4 2 2 3", "kinds: domain domain domain ???\n"
                                          "units: \"mm\" \"mm\" \"mm\" \"ms\"\n")});
    EXPECT_EQ(series->info().steps(), 3u);
}

TEST_F(NrrdAxesTest, WithoutKindsTheSlowestIsTakenForTimeAndANoteSaysSo) {
    const auto series = open_series({file("4 2 2 3", "")});
    EXPECT_EQ(series->info().steps(), 3u);
    EXPECT_THAT(series->info().notes, testing::Contains(HasSubstr("taken for time")));
}

TEST_F(NrrdAxesTest, BothMayBeThereButEachOnce) {
    ReadOptions options;
    options.component = "1";
    const auto series =
        open_series({file("2 3 2 2 2", "kinds: vector domain domain domain time\n")}, options);
    EXPECT_EQ(series->info().steps(), 2u);
    EXPECT_EQ(values_of<std::uint8_t>(*series, 1)[0], 25);
    EXPECT_THAT(complaint("2 3 2 2 2", "kinds: list domain domain domain vector\n"),
                HasSubstr("axes 0 and 4 are both components"));
    EXPECT_THAT(complaint("2 3 2 2 2", "kinds: time domain domain domain vector\n", options),
                HasSubstr("the other way round"));
    EXPECT_THAT(complaint("3 2 2 2 2", "kinds: domain list domain domain time\n"),
                HasSubstr("axis 1 is not one of space"));
}

} // namespace
} // namespace isochron::index
