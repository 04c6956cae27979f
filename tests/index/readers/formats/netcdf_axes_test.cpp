// The positions of the vertices of NetCDF files in space and time.
#include "index/readers/formats/open_series.h"
#include "tests/index/readers/formats/netcdf_writer.h"
#include "tests/support/reader_fixtures.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace isochron::index {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::vector<double> kX{10, 12, 14, 16, 18}, kY{20, 23, 26, 29}, kZ{30, 34, 38};

/// Physical position of the brightest of all values.
glm::dvec3 brightest(const std::filesystem::path& file) {
    const auto series = open_series({file});
    const auto values = values_of<float>(*series, series->info().steps() - 1);
    const auto at = static_cast<std::uint32_t>(std::ranges::max_element(values) - values.begin());
    const auto [nx, ny, nz] = series->info().grid.vertices;
    EXPECT_EQ(nx * ny * nz, values.size());
    return series->info().grid.physical({at % nx, at / nx % ny, at / (nx * ny)});
}

/// One bright value at the fourth x, the second y and the third z, whatever the order of the
/// dimensions.
void put_landmark(NetcdfWriter& out, const std::vector<std::string>& dimensions, bool with_time) {
    const std::string order[]{"x", "y", "z"};
    const std::size_t lengths[]{5, 4, 3}, place[]{3, 1, 2};
    std::size_t at = 0, count = 1;
    for (const std::string& dimension : dimensions)
        for (std::size_t i = 0; i < 3; ++i)
            if (dimension.back() == order[i].back()) {
                at = at * lengths[i] + place[i];
                count *= lengths[i];
            }
    std::vector<float> values(count);
    values[at] = 1;
    if (with_time)
        values.insert(values.begin(), count, 0.0f);
    out.variable("v", NC_FLOAT, dimensions);
    out.put("v", values);
}

TEST(NetcdfAxes, WithoutNamesAreInTheOrderOfStorage) {
    TestFolder folder;
    NetcdfWriter out(folder.path() / "plain.nc", NC_NETCDF4);
    out.dimension("dim0_t", 2);
    out.dimension("dim1z", 3);
    out.dimension("dim2y", 4);
    out.dimension("dim3x", 5);
    put_landmark(out, {"dim0_t", "dim1z", "dim2y", "dim3x"}, true);
    const auto file = out.done();
    EXPECT_EQ(brightest(file), glm::dvec3(3, 1, 2));
    const auto series = open_series({file});
    EXPECT_EQ(series->info().times, (std::vector<double>{0, 1}));
    EXPECT_EQ(series->info().anatomy, Anatomy::none);
    EXPECT_THAT(series->info().notes, ElementsAre(HasSubstr("is taken for time")));
}

TEST(NetcdfAxes, InOtherUnitsAreBroughtInProportionByAPowerOfTen) {
    TestFolder folder;
    NetcdfWriter out(folder.path() / "earth.nc", NC_CLASSIC_MODEL);
    out.axis("lon", kX, "degrees_east");
    out.axis("lat", kY, "degrees_north");
    out.axis("height", {0, 400, 800}, "m");
    out.variable("v", NC_FLOAT, {"height", "lat", "lon"});
    const auto file = out.done();
    const auto series = open_series({file});
    const SeriesInfo& info = series->info();
    EXPECT_EQ(info.grid.spacing, glm::dvec3(2, 3, 4));
    EXPECT_EQ(info.length_unit, "");
    EXPECT_THAT(info.axis_names, ElementsAre("lon (degrees)", "lat (degrees)", "height (m / 100)"));
    EXPECT_THAT(info.notes, ElementsAre("units differ: x (lon) degrees, y (lat) degrees, "
                                        "z (height) m / 100; --spacing sets other proportions"));
    ReadOptions options;
    options.spacing = glm::dvec3(1, 1, 0.5);
    const auto chosen = open_series({file}, options);
    EXPECT_EQ(chosen->info().grid.spacing, glm::dvec3(1, 1, 0.5));
    EXPECT_THAT(chosen->info().notes, IsEmpty());
}

TEST(NetcdfAxes, ThatAreNotUniformKeepTheirPositionsAndNames) {
    TestFolder folder;
    NetcdfWriter out(folder.path() / "stretched.nc", NC_CLASSIC_MODEL);
    out.axis("x", {0, 1.01, 2, 3, 4}, "m"); // not worth a note
    out.axis("y", kY, "m");
    out.axis("z", {5, 6, 11}, "m");
    put_landmark(out, {"z", "y", "x"}, false);
    const auto file = out.done();
    const auto series = open_series({file});
    EXPECT_EQ(series->info().grid.spacing, glm::dvec3(1, 3, 3));
    EXPECT_EQ(series->info().grid.origin, glm::dvec3(0, 20, 5));
    EXPECT_THAT(series->info().notes, ElementsAre("z (z) is not uniform: vertices 1 to 5 m apart"));
    const index::Grid& grid = series->info().grid;
    EXPECT_EQ(grid.positions[0].distances(), (std::vector<double>{0, 1.01, 2, 3, 4}));
    EXPECT_TRUE(grid.positions[1].even());
    EXPECT_EQ(grid.positions[2].distances(), (std::vector<double>{0, 1, 6}));
    EXPECT_EQ(grid.physical({1, 0, 1}), glm::dvec3(1.01, 20, 6));
}

TEST(NetcdfAxes, OfOneSeriesMayDifferByRounding) {
    TestFolder folder;
    const auto open_with = [&](double second) {
        std::vector<std::filesystem::path> files;
        for (const double x : {1.0, second}) {
            const std::string name = x == 1 ? "t1.nc" : "t2.nc";
            NetcdfWriter out(folder.path() / name, NC_CLASSIC_MODEL);
            out.axis("x", {0, x, 2, 3, 4}, "m");
            out.axis("y", kY, "m");
            out.axis("z", kZ, "m");
            put_landmark(out, {"z", "y", "x"}, false);
            files.push_back(out.done());
        }
        return open_series(files);
    };
    EXPECT_EQ(open_with(1.00005)->info().steps(), 2u) << "one is even, the other is not";
    EXPECT_THAT(error_of([&] { open_with(1.001); }),
                HasSubstr("t2.nc: other positions of vertices along axis 0 than"));
}

TEST(NetcdfAxes, ThatGoToAndFroAreRefusedUnlessTheSpacingIsGiven) {
    TestFolder folder;
    for (const double second : {10.0, 9.0, std::nan("")}) {
        NetcdfWriter out(folder.path() / "fro.nc", NC_CLASSIC_MODEL);
        out.axis("x", {10, second, 14, 16, 18}, "m");
        out.axis("y", kY, "m");
        out.axis("z", kZ, "m");
        put_landmark(out, {"z", "y", "x"}, false);
        const auto file = out.done();
        EXPECT_THAT(error_of([&] { open_series({file}); }),
                    HasSubstr("fro.nc: x (x): " +
                              std::string(std::isnan(second) ? "nan"
                                          : second > 9       ? "10"
                                                             : "9") +
                              " after 10, expected coordinates that all increase or all decrease"));
        ReadOptions options;
        options.spacing = glm::dvec3(1);
        EXPECT_EQ(open_series({file}, options)->info().grid.spacing, glm::dvec3(1));
    }
}

std::filesystem::path at_times(const TestFolder& folder, const char* name,
                               const std::vector<double>& times,
                               const char* unit = "s since 2000-01-01") {
    NetcdfWriter out(folder.path() / name, NC_CLASSIC_MODEL);
    out.dimension("time", NC_UNLIMITED);
    for (const char* dimension : {"z", "y", "x"})
        out.dimension(dimension, 2);
    out.variable("time", NC_DOUBLE, {"time"});
    out.text("time", "units", unit);
    out.variable("v", NC_FLOAT, {"time", "z", "y", "x"});
    out.put("time", times);
    std::vector<float> values;
    for (const double time : times)
        values.insert(values.end(), 8, static_cast<float>(time));
    out.put("v", values);
    return out.done();
}

TEST(NetcdfTimes, OfSeveralFilesFollowEachOther) {
    TestFolder folder;
    const auto series =
        open_series({at_times(folder, "b10.nc", {5}), at_times(folder, "b2.nc", {1, 2, 4})});
    EXPECT_EQ(series->info().times, (std::vector<double>{1, 2, 4, 5}));
    for (std::size_t step = 0; step < 4; ++step)
        EXPECT_EQ(values_of<float>(*series, step)[0], series->info().times[step]);
    EXPECT_THAT(
        error_of([&] {
            open_series({at_times(folder, "a.nc", {1, 1})});
        }),
        HasSubstr(
            "a.nc: time 1 (2000-01-01 00:00:01) of its step 1 is that of the step before it"));
    EXPECT_THAT(error_of([&] { open_series({at_times(folder, "a.nc", {})}); }),
                HasSubstr("a.nc: v(time 0, z 2, y 2, x 2) has 0 steps, expected at least 1"));
}

TEST(NetcdfTimes, OfOtherReferenceDatesFollowInThatOfTheFirst) {
    TestFolder folder;
    const auto series =
        open_series({at_times(folder, "1.nc", {0, 12}, "hours since 2000-02-28"),
                     at_times(folder, "2.nc", {0, 720}, "minutes since 2000-02-29T00:00:00Z"),
                     at_times(folder, "3.nc", {0}, "days since 2000-03-01 02:30:00 +2:30")});
    EXPECT_EQ(series->info().times, (std::vector<double>{0, 12, 24, 36, 48}));
    EXPECT_EQ(series->info().time_unit, "hours since 2000-02-28");
    EXPECT_THAT(error_of([&] {
                    open_series({at_times(folder, "1.nc", {0}, "hours since 2000-02-28"),
                                 at_times(folder, "2.nc", {0}, "blinks since 2000-02-29")});
                }),
                testing::AllOf(HasSubstr("2.nc: times in blinks since 2000-02-29, "),
                               HasSubstr("1.nc has hours since 2000-02-28; --time-step")));
}

TEST(NetcdfTimes, MayBeASingleNumberBesideTheField) {
    TestFolder folder;
    NetcdfWriter out(folder.path() / "one.nc", NC_NETCDF4);
    for (const char* dimension : {"z", "y", "x"})
        out.dimension(dimension, 2);
    out.variable("reference", NC_DOUBLE, {});
    out.text("reference", "units", "hours since 1990-01-01");
    out.variable("valid", NC_DOUBLE, {});
    out.text("valid", "units", "hours since 2000-01-01");
    out.text("valid", "standard_name", "time");
    out.put("valid", std::vector<double>{36});
    out.variable("v", NC_FLOAT, {"z", "y", "x"});
    const auto series = open_series({out.done()});
    EXPECT_EQ(series->info().times, std::vector<double>{36});
    EXPECT_EQ(series->info().time_unit, "hours since 2000-01-01");
}

TEST(NetcdfGrid, OfAttributesIsThatOfOpenPmd) {
    TestFolder folder;
    for (const bool of_group : {false, true}) {
        NetcdfWriter out(folder.path() / (of_group ? "g.nc" : "v.nc"), NC_NETCDF4);
        if (of_group)
            out.enter_group("E");
        out.dimension("d0", 3);
        out.dimension("d1", 4);
        out.dimension("d2", 5);
        out.variable("f", NC_FLOAT, {"d0", "d1", "d2"});
        const char* on = of_group ? nullptr : "f";
        out.number<double>(on, "gridSpacing", {4, 3, 2});
        out.number<double>(on, "gridGlobalOffset", {30, 20, 10});
        out.number<double>(on, "gridUnitSI", {0.001});
        out.put("f", std::vector<float>(60, 1));
        const auto series = open_series({out.done()});
        const Grid& grid = series->info().grid;
        EXPECT_EQ(grid.spacing, glm::dvec3(2, 3, 4) * 0.001) << of_group;
        EXPECT_EQ(grid.origin, glm::dvec3(10, 20, 30) * 0.001);
        EXPECT_EQ(series->info().length_unit, "m");
    }
}

} // namespace
} // namespace isochron::index
