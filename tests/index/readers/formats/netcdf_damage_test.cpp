// NetCDF files that are cut short, inconsistent or without a volume: one clear error line each.
#include "index/readers/formats/open_series.h"
#include "tests/index/readers/formats/netcdf_writer.h"
#include "tests/support/reader_fixtures.h"

#include <gmock/gmock.h>

#include <random>

namespace isochron::index {
namespace {

using testing::HasSubstr;

/// Two variables over records, one without, in any form.
std::filesystem::path whole_file(const TestFolder& folder, int form, std::size_t records = 2) {
    NetcdfWriter out(folder.path() / "whole.nc", form);
    out.dimension("time", NC_UNLIMITED);
    out.axis("z", {1, 2, 3}, "m");
    out.axis("y", {1, 2, 3}, "m");
    out.axis("x", {1, 2, 3}, "m");
    out.variable("still", NC_BYTE, {"z", "y"});
    out.variable("w", NC_SHORT, {"time", "z", "y", "x"});
    out.variable("v", NC_BYTE, {"time", "z", "y", "x"});
    out.text("v", "long_name", "of 27 bytes in each record, with one of padding");
    out.put("w", ramp<std::int16_t>(27 * records));
    out.put("v", ramp<std::int8_t>(27 * records));
    return out.done();
}

/// Reads all of `v`.
void read_all(const std::filesystem::path& file) {
    ReadOptions options;
    options.array = "v";
    const auto series = open_series({file}, options);
    for (std::size_t step = 0; step < series->info().steps(); ++step)
        values_of<std::int8_t>(*series, step);
}

TEST(DamagedNetcdf, CutShortAnywhereIsRefused) {
    TestFolder folder;
    for (const int form : kNetcdfForms) {
        const auto file = whole_file(folder, form);
        read_all(file);
        const std::string whole = read_file(file);
        // The classic forms pad the last value to four bytes: only that may be missing.
        const std::size_t needed = whole.size() - (form == NC_NETCDF4 ? 0 : 1);
        for (std::size_t size = 0; size < needed; size += size + 40 < needed ? 37 : 1)
            EXPECT_THAT(error_of([&] { read_all(folder.write("cut.nc", whole.substr(0, size))); }),
                        HasSubstr("cut.nc: "))
                << "form " << form << ", " << size << " of " << whole.size() << " bytes";
    }
}

TEST(DamagedNetcdf, OfASingleRecordedVariableHasNoPadding) {
    TestFolder folder;
    NetcdfWriter out(folder.path() / "single.nc", NC_CLASSIC_MODEL);
    out.dimension("time", NC_UNLIMITED);
    for (const char* dimension : {"z", "y", "x"})
        out.dimension(dimension, 3);
    out.variable("v", NC_BYTE, {"time", "z", "y", "x"});
    out.put("v", ramp<std::int8_t>(81));
    const auto file = out.done();
    read_all(file);
    const std::string whole = read_file(file);
    EXPECT_THAT(error_of([&] {
                    read_all(folder.write("cut.nc", whole.substr(0, whole.size() / 4 * 4 - 4)));
                }),
                HasSubstr("cut.nc: truncated: "));
}

TEST(DamagedNetcdf, SaysWhatIsWrong) {
    TestFolder folder;
    EXPECT_THAT(error_of([&] { open_series({folder.write("a.nc", "PNG, surely")}); }),
                HasSubstr("a.nc: not NetCDF: it starts neither with CDF nor as HDF5 does"));
    EXPECT_THAT(error_of([&] { open_series({folder.write("a.nc", "")}); }),
                HasSubstr("a.nc: not NetCDF"));
    const std::string whole = read_file(whole_file(folder, NC_NETCDF4));
    EXPECT_THAT(error_of([&] { open_series({folder.write("a.nc", whole.substr(0, 3000))}); }),
                HasSubstr("a.nc: damaged or truncated: NetCDF: HDF error"));
    const std::string classic = read_file(whole_file(folder, NC_CLASSIC_MODEL));
    EXPECT_THAT(error_of([&] { open_series({folder.write("a.nc", classic.substr(0, 100))}); }),
                HasSubstr("a.nc: truncated: its header does not end within 100 bytes"));
    EXPECT_THAT(error_of([&] { open_series({folder.path() / "none.nc"}); }),
                HasSubstr("none.nc: there is no such file"));
}

TEST(DamagedNetcdf, WithLyingCountsCostsNoMemory) {
    TestFolder folder;
    const std::string whole = read_file(whole_file(folder, NC_CLASSIC_MODEL));
    int refused = 0;
    // Every word of the header in turn: counts, lengths, types, offsets and letters.
    for (std::size_t at = 4; at < 600; at += 4)
        for (const char* word : {"\x7f\xff\xff\xff", "\xff\xff\xff\xff", "\0\1\0\0", "\0\0\0\0"}) {
            std::string lie = whole;
            lie.replace(at, 4, word, 4);
            try {
                read_all(folder.write("lie.nc", lie));
            } catch (const Error& error) {
                EXPECT_THAT(error.what(), HasSubstr("lie.nc: "));
                ++refused;
            }
        }
    EXPECT_GT(refused, 200);
}

TEST(DamagedNetcdf, WithHugeDimensionsCostsNoMemory) {
    TestFolder folder;
    for (const bool chunked : {false, true}) {
        NetcdfWriter out(folder.path() / "huge.nc", NC_NETCDF4);
        for (const char* dimension : {"z", "y", "x"})
            out.dimension(dimension, 1600);
        out.variable("v", NC_SHORT, {"z", "y", "x"});
        if (chunked)
            out.deflate("v", {100, 100, 100});
        EXPECT_THAT(error_of([&] { open_series({out.done()}); }),
                    HasSubstr("huge.nc: truncated: 8192000000 bytes of data expected"));
    }
    NetcdfWriter out(folder.path() / "cells.nc", NC_64BIT_DATA);
    for (const char* dimension : {"z", "y", "x"})
        out.dimension(dimension, std::size_t{1} << 40);
    out.variable("scalar", NC_BYTE, {});
    EXPECT_THAT(error_of([&] { open_series({out.done()}); }),
                HasSubstr("cells.nc: holds no array"));
}

TEST(DamagedNetcdf, OfRandomBytesNeverCrashes) {
    TestFolder folder;
    constexpr unsigned kSeed = 20;
    SCOPED_TRACE(kSeed);
    std::mt19937 random(kSeed);
    for (const int form : {NC_CLASSIC_MODEL, NC_64BIT_DATA}) {
        const std::string whole = read_file(whole_file(folder, form));
        for (int round = 0; round < 400; ++round) {
            std::string damaged = whole;
            for (int i = 0; i < 4; ++i)
                damaged[4 + random() % 700] = static_cast<char>(random());
            try {
                read_all(folder.write("random.nc", damaged));
            } catch (const Error& error) {
                EXPECT_THAT(error.what(), HasSubstr("random.nc: "));
            }
        }
    }
}

std::string refusal(const TestFolder& folder, nc_type type,
                    const std::vector<std::string>& dimensions, bool named = false) {
    NetcdfWriter out(folder.path() / "odd.nc", NC_NETCDF4);
    for (const char* name : {"member", "time", "z", "y", "x"})
        out.dimension(name, 2);
    out.variable("v", type, dimensions);
    const auto file = out.done();
    ReadOptions options;
    if (named)
        options.array = "v";
    return error_of([&] { open_series({file}, options); });
}

TEST(NetcdfWithoutVolume, IsRefusedInTheWordsThatMatter) {
    TestFolder folder;
    EXPECT_THAT(refusal(folder, NC_FLOAT, {"time", "y", "x"}),
                HasSubstr("odd.nc: holds no array with three dimensions of more than one vertex "
                          "besides time: v(time 2, y 2, x 2)"));
    EXPECT_THAT(refusal(folder, NC_FLOAT, {"time", "member", "z", "y", "x"}, true),
                HasSubstr("odd.nc: v has 2 members along member, choose one with --member 0 to 1"));
    EXPECT_THAT(refusal(folder, NC_FLOAT, {"x"}), HasSubstr("odd.nc: holds no array with three"));
    EXPECT_THAT(refusal(folder, NC_CHAR, {"z", "y", "x"}), HasSubstr("odd.nc: holds no array"));
    for (const nc_type type : {NC_CHAR, NC_STRING})
        EXPECT_THAT(refusal(folder, type, {"z", "y", "x"}, true),
                    HasSubstr("odd.nc: array v does not hold numbers that can be read"));
}

} // namespace
} // namespace isochron::index
