// Values of NetCDF files: every type in every form, packed, missing, and those of real files.
#include "index/readers/formats/open_series.h"
#include "tests/index/readers/formats/netcdf_writer.h"
#include "tests/support/paths.h"
#include "tests/support/reader_fixtures.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <thread>

namespace isochron::index {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::size_t kSteps = 3, kVertices = 2 * 3 * 4;
const std::vector<std::string> kDimensions{"time", "z", "y", "x"};

/// A file with `v` over time, z, y and x, whose values are still to be put.
class Field {
  public:
    Field(const TestFolder& folder, int form, nc_type type, std::size_t steps = kSteps)
        : out_(folder.path() / "field.nc", form) {
        out_.dimension("time", steps);
        out_.dimension("z", 2);
        out_.dimension("y", 3);
        out_.dimension("x", 4);
        out_.variable("v", type, kDimensions);
    }
    NetcdfWriter& out() { return out_; }
    template <class T>
    std::unique_ptr<VolumeSeries> with(const std::vector<T>& values) {
        out_.put("v", values);
        return open_series({out_.done()});
    }

  private:
    NetcdfWriter out_;
};

template <class T>
std::vector<T> step_of(const std::vector<T>& values, std::size_t step) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(step * kVertices);
    return {first, first + kVertices};
}

/// Values from one end of the type to the other.
template <class T>
std::vector<T> some_values() {
    std::vector<T> values;
    for (std::size_t i = 0; i < kSteps * kVertices; ++i)
        values.push_back(static_cast<T>(i * 7 - 50));
    values[0] = std::numeric_limits<T>::lowest();
    values[1] = std::numeric_limits<T>::max();
    return values;
}

template <class T>
void expect_in_form(int form, nc_type type) {
    TestFolder folder;
    const std::vector<T> values = some_values<T>();
    const auto series = Field(folder, form, type).with(values);
    EXPECT_EQ(series->info().array, "v");
    EXPECT_EQ(series->info().grid.vertices, (std::array<std::uint32_t, 3>{4, 3, 2}));
    EXPECT_EQ(series->info().scaling, Scaling{});
    EXPECT_THAT(series->info().notes, IsEmpty());
    ASSERT_EQ(series->info().steps(), kSteps);
    for (const std::size_t step : {2, 0, 1})
        EXPECT_EQ(values_of<T>(*series, step), step_of(values, step)) << "form " << form;
}

TEST(NetcdfValues, OfEveryTypeComeFromEveryForm) {
    for (const int form : kNetcdfForms) {
        expect_in_form<std::int8_t>(form, NC_BYTE);
        expect_in_form<std::int16_t>(form, NC_SHORT);
        expect_in_form<std::int32_t>(form, NC_INT);
        expect_in_form<float>(form, NC_FLOAT);
        expect_in_form<double>(form, NC_DOUBLE);
    }
    for (const int form : {NC_64BIT_DATA, NC_NETCDF4}) {
        expect_in_form<std::uint8_t>(form, NC_UBYTE);
        expect_in_form<std::uint16_t>(form, NC_USHORT);
    }
}

TEST(NetcdfValues, OfWideIntegersBecomeExactF64) {
    TestFolder folder;
    std::vector<std::uint32_t> values = ramp<std::uint32_t>(kVertices, 4294967200);
    EXPECT_EQ(values_of<double>(*Field(folder, NC_NETCDF4, NC_UINT, 1).with(values), 0),
              ramp<double>(kVertices, 4294967200.0));
    std::vector<std::int64_t> wide = ramp<std::int64_t>(kVertices, -12);
    const auto series = Field(folder, NC_64BIT_DATA, NC_INT64, 1).with(wide);
    EXPECT_THAT(series->info().notes, ElementsAre("i64 values converted to f64"));
    EXPECT_EQ(values_of<double>(*series, 0), ramp<double>(kVertices, -12));
    wide[5] = 9007199254740993;
    const auto beyond = Field(folder, NC_NETCDF4, NC_INT64, 1).with(wide);
    EXPECT_THAT(error_of([&] { values_of<double>(*beyond, 0); }),
                HasSubstr("field.nc: the value 9007199254740993 has no exact f64"));
}

TEST(NetcdfValues, OfUnsignedBytesInClassicFiles) {
    TestFolder folder;
    Field field(folder, NC_CLASSIC_MODEL, NC_BYTE, 1);
    field.out().text("v", "_Unsigned", "true");
    const auto series = field.with(ramp<std::int8_t>(kVertices, -20));
    EXPECT_EQ(values_of<std::uint8_t>(*series, 0), ramp<std::uint8_t>(kVertices, 236));
}

TEST(NetcdfValues, ThatAreDeflatedAndChunkedOverTime) {
    TestFolder folder;
    Field field(folder, NC_NETCDF4, NC_FLOAT);
    field.out().deflate("v", {2, 1, 2, 3});
    const auto values = some_values<float>();
    const auto series = field.with(values);
    for (const std::size_t step : {2, 0, 1})
        EXPECT_EQ(values_of<float>(*series, step), step_of(values, step));
}

TEST(NetcdfValues, KeepTheirTypeWhenTheyArePacked) {
    TestFolder folder;
    Field field(folder, NC_CLASSIC_MODEL, NC_SHORT, 1);
    field.out().number<double>("v", "scale_factor", {0.5});
    field.out().number<float>("v", "add_offset", {270});
    field.out().text("v", "units", "K");
    const auto series = field.with(ramp<std::int16_t>(kVertices, -5));
    EXPECT_EQ(series->info().scaling, (Scaling{0.5, 270}));
    EXPECT_EQ(series->info().value_unit, "K");
    EXPECT_EQ(values_of<std::int16_t>(*series, 0), ramp<std::int16_t>(kVertices, -5));
}

TEST(NetcdfValues, WithAFactorOfZeroAreRefused) {
    TestFolder folder;
    for (const double factor : {0.0, std::nan("")}) {
        Field field(folder, NC_CLASSIC_MODEL, NC_SHORT, 1);
        field.out().number<double>("v", "scale_factor", {factor});
        EXPECT_THAT(error_of([&] { field.with(ramp<std::int16_t>(kVertices)); }),
                    HasSubstr("field.nc: v: scale_factor "));
    }
}

/// Positions of what is not a number.
template <class T>
std::vector<std::size_t> gaps_in(const std::vector<T>& values) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (std::isnan(values[i]))
            found.push_back(i);
    return found;
}

TEST(MissingValues, OfFloatsAreNotNumbers) {
    TestFolder folder;
    Field field(folder, NC_NETCDF4, NC_FLOAT, 1);
    field.out().number<float>("v", "_FillValue", {-999});
    field.out().number<double>("v", "missing_value", {1e35, -1.1}); // as they are in f32
    auto values = ramp<float>(kVertices);
    values[2] = -999;
    values[3] = 1e35f;
    values[5] = -1.1f;
    const auto series = field.with(values);
    EXPECT_THAT(series->info().notes, IsEmpty());
    const auto read = values_of<float>(*series, 0);
    EXPECT_THAT(gaps_in(read), ElementsAre(2, 3, 5));
    EXPECT_EQ(read[23], 23);
}

TEST(MissingValues, IncludeWhatWasNeverWritten) {
    TestFolder folder;
    for (const int form : kNetcdfForms) {
        Field field(folder, form, NC_DOUBLE, 2);
        const auto series = field.with(ramp<double>(kVertices)); // the first step alone
        EXPECT_THAT(gaps_in(values_of<double>(*series, 0)), IsEmpty());
        EXPECT_EQ(gaps_in(values_of<double>(*series, 1)).size(), kVertices);
    }
}

TEST(MissingValues, OfWideIntegersNeedNoExactF64) {
    TestFolder folder;
    Field field(folder, NC_NETCDF4, NC_INT64, 1);
    const std::int64_t fill = std::numeric_limits<std::int64_t>::min() + 2;
    field.out().number<std::int64_t>("v", "_FillValue", {fill});
    auto values = ramp<std::int64_t>(kVertices);
    values[7] = fill;
    EXPECT_THAT(gaps_in(values_of<double>(*field.with(values), 0)), ElementsAre(7));
}

TEST(MissingValues, LieOutsideTheValidRange) {
    TestFolder folder;
    const auto gaps = [&](auto&& attributes) {
        Field field(folder, NC_NETCDF4, NC_SHORT, 1);
        field.out().template number<double>("v", "scale_factor", {-0.1});
        attributes(field.out());
        return gaps_in(values_of<float>(*field.with(ramp<std::int16_t>(kVertices)), 0));
    };
    using Short = std::int16_t;
    EXPECT_THAT(gaps([](NetcdfWriter& out) { out.number<Short>("v", "valid_min", {2}); }),
                ElementsAre(0, 1));
    EXPECT_THAT(gaps([](NetcdfWriter& out) { out.number<Short>("v", "valid_max", {21}); }),
                ElementsAre(22, 23));
    EXPECT_THAT(gaps([](NetcdfWriter& out) {
                    out.number<Short>("v", "valid_range", {1, 22});
                }),
                ElementsAre(0, 23));
    // Real limits of integers are those of the unpacked values, which run from 0 down to -2.3.
    EXPECT_THAT(gaps([](NetcdfWriter& out) {
                    out.number<float>("v", "valid_range", {-2.1f, -0.2f});
                }),
                ElementsAre(0, 1, 22, 23));
}

TEST(MissingValues, OfUnsignedBytesAreWrittenWithASign) {
    TestFolder folder;
    Field field(folder, NC_CLASSIC_MODEL, NC_BYTE, 1);
    field.out().text("v", "_Unsigned", "true");
    field.out().number<std::int8_t>("v", "_FillValue", {-1});
    field.out().number<std::int8_t>("v", "valid_range", {0, -3}); // 0 to 253
    const auto read = values_of<float>(*field.with(ramp<std::int8_t>(kVertices, -24)), 0);
    EXPECT_THAT(gaps_in(read), ElementsAre(22, 23));
    EXPECT_EQ(read[0], 232);
}

TEST(NetcdfVariables, AreListedWhenNoneIsChosen) {
    TestFolder folder;
    NetcdfWriter out(folder.path() / "two.nc", NC_NETCDF4);
    for (const char* name : {"z", "y", "x"})
        out.dimension(name, 2);
    out.dimension("corners", 4);
    out.variable("u", NC_SHORT, {"z", "y", "x"});
    out.variable("flat", NC_FLOAT, {"y", "x"});
    out.variable("x_corners", NC_FLOAT, {"y", "x", "corners"});
    out.text("flat", "bounds", "x_corners");
    out.enter_group("forecast");
    out.variable("w", NC_FLOAT, {"z", "y", "x"});
    out.put("w", ramp<float>(8));
    const auto file = out.done();
    EXPECT_THAT(error_of([&] { open_series({file}); }),
                HasSubstr("two.nc: several arrays, choose one with --array: u (i16, 2 x 2 x 2), "
                          "forecast/w (f32, 2 x 2 x 2)"));
    ReadOptions options;
    options.array = "forecast/w";
    EXPECT_EQ(values_of<float>(*open_series({file}, options), 0), ramp<float>(8));
    options.array = "v";
    EXPECT_THAT(error_of([&] { open_series({file}, options); }),
                HasSubstr("two.nc: no array v, expected one of: u (i16, 2 x 2 x 2), forecast/w "
                          "(f32, 2 x 2 x 2)"));
    options.array = "flat";
    EXPECT_THAT(error_of([&] { open_series({file}, options); }),
                HasSubstr("two.nc: array flat(y 2, x 2), expected three dimensions of more than "
                          "one vertex besides time"));
}

TEST(NetcdfFiles, MayBeReadByManyThreadsAtOnce) {
    TestFolder folder;
    const auto values = some_values<float>();
    Field(folder, NC_NETCDF4, NC_FLOAT).with(values);
    testing::internal::CaptureStderr(); // each thread has its own HDF5 errors to print
    std::vector<std::thread> readers;
    for (int i = 0; i < 4; ++i)
        readers.emplace_back([&] {
            for (int round = 0; round < 20; ++round) {
                const auto series = open_series({folder.path() / "field.nc"});
                for (std::size_t step = 0; step < kSteps; ++step)
                    EXPECT_EQ(values_of<float>(*series, step), step_of(values, step));
            }
        });
    for (std::thread& reader : readers)
        reader.join();
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// Sums and single values from the files' text as ncdump 4.9 prints it.
TEST(RealNetcdf, OfTheMetOfficeHasItsTemperatures) {
    const auto series = open_series(
        {std::filesystem::path(test_support::test_data()) / "formats" / "small_theta_colpex.nc"});
    const SeriesInfo& info = series->info();
    EXPECT_EQ(info.array, "air_potential_temperature");
    EXPECT_EQ(info.value_unit, "K");
    EXPECT_EQ(info.grid.vertices, (std::array<std::uint32_t, 3>{83, 83, 10}));
    EXPECT_EQ(info.anatomy, Anatomy::enu);
    EXPECT_EQ(info.times.size(), 6u);
    EXPECT_EQ(info.times[5], 347922);
    EXPECT_EQ(info.time_unit, "hours since 1970-01-01 00:00:00");
    EXPECT_THAT(info.notes, ElementsAre(HasSubstr("x (grid_longitude) is not uniform"),
                                        HasSubstr("y (grid_latitude) is not uniform"),
                                        HasSubstr("z (model_level_number) / 100; --spacing"),
                                        HasSubstr("stated and not used: ukmo__um_stash_source")));
    const auto sum = [&](std::size_t step) {
        const auto values = values_of<float>(*series, step);
        return std::accumulate(values.begin(), values.end(), 0.0);
    };
    EXPECT_NEAR(sum(0), 19827682.4064, 0.01);
    EXPECT_NEAR(sum(5), 19770070.3349, 0.01);
    EXPECT_NEAR(values_of<float>(*series, 5)[1234], 286.476593, 1e-4);
}

TEST(NetcdfGrid, SizesOfCellsAreOfferedAndNotTaken) {
    TestFolder folder;
    NetcdfWriter out(folder.path() / "wrfout.nc", NC_CLASSIC_MODEL);
    out.dimension("bottom_top", 3);
    out.dimension("south_north", 4);
    out.dimension("west_east", 5);
    out.variable("T", NC_FLOAT, {"bottom_top", "south_north", "west_east"});
    out.number<float>(nullptr, "DX", {3000});
    out.number<float>(nullptr, "DY", {2500});
    out.put("T", std::vector<float>(60, 1));
    const std::filesystem::path file = out.done();
    const auto series = open_series({file});
    EXPECT_EQ(series->info().grid.spacing, glm::dvec3(1));
    EXPECT_THAT(series->info().notes, testing::Contains(HasSubstr("--spacing 3000 2500 DZ")));
    ReadOptions options;
    options.spacing = glm::dvec3(3000, 2500, 500);
    EXPECT_THAT(open_series({file}, options)->info().notes,
                testing::Not(testing::Contains(HasSubstr("DX"))));
}

TEST(RealNetcdf, OfTheOceanIsMissingOnLand) {
    const auto series = open_series(
        {std::filesystem::path(test_support::test_data()) / "formats" / "foam.ocean.nc"});
    const SeriesInfo& info = series->info();
    EXPECT_EQ(info.times, std::vector<double>{359670});
    EXPECT_EQ(info.grid.spacing.x, 2.8125);
    EXPECT_NEAR(info.grid.spacing.z, 2.3, 1e-6); // hundreds of meters
    EXPECT_EQ(gaps_in(values_of<float>(*series, 0)).size(), 200564u);
}

} // namespace
} // namespace isochron::index
