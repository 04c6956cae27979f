// Files of VTK: every encoding of .vti, legacy .vtk, the choice of arrays, and damaged files.
#include "index/readers/formats/open_series.h"
#include "tests/support/paths.h"
#include "tests/support/reader_fixtures.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace isochron::index {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::filesystem::path kFolder = std::filesystem::path(test_support::test_data()) / "vti";
const std::filesystem::path kFlow =
    std::filesystem::path(test_support::test_data()) / "formats" / "flow.vti";

std::vector<std::int16_t> expected_values() {
    auto values = ramp<std::int16_t>(60);
    for (std::int16_t& v : values)
        v = static_cast<std::int16_t>(v * 7 - 100);
    return values;
}

// The files were written by VTK 9.1 through its Python module: values 7 i - 100, extent 2 6 -1 2 0
// 2, origin 10 20 30, spacing 0.5 1 2, axes turned by 90 degrees about z, time 2.5.
class Vti : public testing::TestWithParam<const char*> {};

TEST_P(Vti, HasTheSameContentInEveryEncoding) {
    const auto series = open_series({kFolder / GetParam()});
    const SeriesInfo& info = series->info();
    EXPECT_EQ(info.grid.vertices, (std::array<std::uint32_t, 3>{5, 4, 3}));
    EXPECT_EQ(info.grid.spacing, glm::dvec3(0.5, 1, 2));
    EXPECT_EQ(info.grid.direction, glm::dmat3(0, 1, 0, -1, 0, 0, 0, 0, 1));
    EXPECT_EQ(info.grid.origin, glm::dvec3(10 + 1, 20 + 1, 30)); // vertex 2 -1 0
    EXPECT_EQ(info.times, std::vector<double>{2.5});
    EXPECT_EQ(info.array, "p");
    EXPECT_EQ(values_of<std::int16_t>(*series, 0), expected_values());
    const bool lz4 = std::string_view(GetParam()).find("lz4") != std::string_view::npos;
    EXPECT_EQ(testing::Value(info.notes, testing::Contains(HasSubstr("LZ4 data"))), lz4);
}

INSTANTIATE_TEST_SUITE_P(Encodings, Vti,
                         testing::Values("ascii.vti", "inline_plain32.vti", "inline_zlib32.vti",
                                         "inline_lz432.vti", "raw_plain32.vti", "raw_zlib32.vti",
                                         "raw_lz432.vti", "base64_plain32.vti", "base64_zlib32.vti",
                                         "base64_lz432.vti", "inline_plain64.vti",
                                         "inline_zlib64.vti", "inline_lz464.vti", "raw_plain64.vti",
                                         "raw_zlib64.vti", "raw_lz464.vti", "base64_plain64.vti",
                                         "base64_zlib64.vti", "base64_lz464.vti", "raw_lzma64.vti",
                                         "big_endian.vti", "pieces.vti"));

TEST(Vtk, ReadsLegacyAsciiAndBinary) {
    for (const char* file : {"ascii.vtk", "binary.vtk"}) {
        const auto series = open_series({kFolder / file});
        EXPECT_EQ(series->info().grid.origin, glm::dvec3(10, 20, 30));
        EXPECT_EQ(series->info().grid.spacing, glm::dvec3(0.5, 1, 2));
        EXPECT_EQ(values_of<std::int16_t>(*series, 0), expected_values()) << file;
    }
}

TEST(VtkArrays, AreListedWhenNoneIsChosen) {
    const std::string message = error_of([] { open_series({kFlow}); });
    EXPECT_THAT(message, AllOf(HasSubstr("choose one with --array"), HasSubstr("RTData (f32)"),
                               HasSubstr("FlowVelocity (f64 x 3)")));
    EXPECT_THAT(message, testing::Not(HasSubstr("vtkGhostType")));
    ReadOptions options;
    options.array = "vtkGhostType";
    EXPECT_THAT(error_of([&] { open_series({kFlow}, options); }),
                HasSubstr("no array vtkGhostType, expected one of: FlowDensity"));
}

// Sums from the bytes of the file, with NumPy.
TEST(VtkArrays, OfVectorsGiveAComponentOrTheirMagnitude) {
    ReadOptions options;
    options.array = "FlowVelocity";
    EXPECT_THAT(error_of([&] { open_series({kFlow}, options); }),
                HasSubstr("3 components, choose one with --component"));
    const auto sum = [&](const char* component) {
        options.component = component;
        const auto series = open_series({kFlow}, options);
        EXPECT_EQ(series->info().array, std::string("FlowVelocity.") + component);
        double total = 0;
        for (double v : values_of<double>(*series, 0))
            total += v;
        return total;
    };
    EXPECT_NEAR(sum("magnitude"), 2102.8344434452492, 1e-9);
    EXPECT_NEAR(sum("0"), 1486.9284946727755, 1e-9);
    options.component = "3";
    EXPECT_THAT(error_of([&] { open_series({kFlow}, options); }),
                HasSubstr("has no component 3, expected 0 to 2 or magnitude"));
}

TEST(VtkArrays, OfCellsAreAveragedToVertices) {
    const auto series = open_series({kFolder / "cells.vti"});
    EXPECT_THAT(series->info().notes, testing::ElementsAre("cell data averaged to vertices"));
    const auto values = values_of<float>(*series, 0);
    const auto cell = [](int x, int y, int z) {
        const int i = (z * 3 + y) * 4 + x;
        return i * i;
    };
    EXPECT_EQ(values[0], cell(0, 0, 0));
    EXPECT_EQ(values[59], cell(3, 2, 1));
    float inner = 0; // vertex 2 1 1 lies between 8 cells
    for (int corner = 0; corner < 8; ++corner)
        inner += float(cell(1 + (corner & 1), corner >> 1 & 1, corner >> 2)) / 8;
    EXPECT_EQ(values[(1 * 4 + 1) * 5 + 2], inner);
}

TEST(VtkArrays, OfWideIntegersBecomeExactF64) {
    const auto wide = open_series({kFolder / "u32.vti"});
    EXPECT_EQ(values_of<double>(*wide, 0), ramp<double>(60, 4294967200.0));
    EXPECT_THAT(wide->info().notes, testing::ElementsAre("u32 values converted to f64"));
    EXPECT_EQ(values_of<double>(*open_series({kFolder / "i64.vti"}), 0)[1], -93);
    TestFolder folder;
    std::string text = read_file(kFolder / "i64.vti");
    text.replace(text.find("-93"), 3, "9007199254740993");
    const auto series = open_series({folder.write("i64.vti", text)});
    EXPECT_THAT(error_of([&] { values_of<double>(*series, 0); }),
                HasSubstr("9007199254740993 has no exact f64"));
}

TEST(DamagedVti, IsRefusedInOneLine) {
    TestFolder folder;
    int cases = 0;
    for (const char* name : {"ascii.vti", "raw_zlib64.vti", "raw_plain32.vti", "inline_lz464.vti",
                             "base64_zlib32.vti", "ascii.vtk", "binary.vtk"}) {
        const std::string whole = read_file(kFolder / name);
        for (const double part : {0.0, 0.05, 0.3, 0.5, 0.7}) {
            const auto file = folder.write(name, whole.substr(0, part_of(whole.size(), part)));
            const std::string message = error_of([&] {
                const auto series = open_series({file});
                std::vector<std::byte> values(series->info().step_bytes());
                series->read(0, values);
            });
            EXPECT_THAT(message, HasSubstr(name)) << part;
            ++cases;
        }
        EXPECT_THAT(error_of([&] { open_series({folder.write(name, "PNG, surely")}); }),
                    HasSubstr(name));
    }
    EXPECT_EQ(cases, 35);
}

TEST(DamagedVti, LackingItsLastValuesIsRefused) {
    TestFolder folder;
    for (const char* name : {"raw_plain64.vti", "raw_zlib64.vti", "raw_lz432.vti",
                             "base64_plain64.vti", "base64_zlib32.vti", "inline_plain32.vti"}) {
        const std::string whole = read_file(kFolder / name);
        const std::size_t appended = whole.find("</AppendedData>");
        const std::size_t end = std::min(appended, whole.find("</DataArray>"));
        for (const std::size_t missing : {8, 16, 24})
            EXPECT_THAT(error_of([&] {
                            const auto series =
                                open_series({folder.write(name, whole.substr(0, end - missing))});
                            std::vector<std::byte> values(series->info().step_bytes());
                            series->read(0, values);
                        }),
                        HasSubstr("truncated"))
                << name << " without its last " << missing << " bytes";
    }
}

TEST(DamagedVtk, IsRefusedInTheWordsThatMatter) {
    TestFolder folder;
    const std::string whole = read_file(kFolder / "binary.vtk");
    EXPECT_THAT(error_of([&] {
                    open_series({folder.write("cut.vtk", whole.substr(0, whole.size() - 40))});
                }),
                testing::EndsWith("cut.vtk: cannot be read: Error reading binary data!"));
}

TEST(DamagedVti, WithHugeExtentsCostsNoMemory) {
    TestFolder folder;
    std::string text = read_file(kFolder / "raw_plain64.vti");
    for (std::size_t at = 0; (at = text.find("2 6 -1 2 0 2")) != text.npos;)
        text.replace(at, 12, "0 1600 0 1600 0 1600");
    EXPECT_THAT(error_of([&] { open_series({folder.write("huge.vti", text)}); }),
                HasSubstr("huge.vti: truncated"));
    text = read_file(kFolder / "binary.vtk");
    text.replace(text.find("DIMENSIONS 5 4 3"), 16, "DIMENSIONS 1600 1600 1600");
    EXPECT_THAT(error_of([&] { open_series({folder.write("huge.vtk", text)}); }),
                HasSubstr("huge.vtk: truncated"));
    text = read_file(kFolder / "binary.vtk");
    const std::size_t line_end = text.find('\n', text.find("SCALARS"));
    text.insert(line_end, " 2147483647");
    EXPECT_THAT(error_of([&] { open_series({folder.write("wide.vtk", text)}); }),
                HasSubstr("wide.vtk: truncated"));
}

TEST(DamagedVti, LackingAPieceIsRefused) {
    TestFolder folder;
    std::string text = read_file(kFolder / "pieces.vti");
    const std::size_t begin = text.find("<Piece"), end = text.find("</Piece>") + 8;
    text.erase(begin, end - begin);
    EXPECT_THAT(error_of([&] { open_series({folder.write("hole.vti", text)}); }),
                HasSubstr("its pieces hold"));
}

TEST(DamagedVti, WithAPieceWhoseExtentIsNoNumbersIsRefused) {
    TestFolder folder;
    for (const char* extent : {"2 nan", "x 6", "99999999999999999999 6", "", "2 6 -1 2 0"}) {
        std::string text = read_file(kFolder / "raw_plain64.vti");
        const std::size_t at = text.find("2 6 -1 2 0 2", text.find("<Piece"));
        text.replace(at, 12, extent);
        EXPECT_THAT(error_of([&] { open_series({folder.write("piece.vti", text)}); }),
                    HasSubstr("piece.vti: cannot be read"))
            << extent;
    }
}

TEST(LegacyVtk, InfinitiesAndNanAsTextAreRead) {
    TestFolder folder;
    const auto legacy = [&](const std::string& type, const std::string& values,
                            const std::string& name) {
        return folder.write(
            "l.vtk", "# vtk DataFile Version 3.0\nnan inf\nASCII\nDATASET STRUCTURED_POINTS\n"
                     "DIMENSIONS 2 2 2\nORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA 8\nSCALARS " +
                         name + " " + type + " 1\nLOOKUP_TABLE default\n" + values);
    };
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (const char* type : {"float", "double"}) {
        const auto series = open_series(
            {legacy(type, "1 nan -inf\ninf\n +Infinity\t-NaN -1.5 -Infinity\n", "inf")});
        EXPECT_EQ(series->info().array, "inf");
        std::vector<double> values;
        if (series->info().type == ValueType::f32)
            for (const float value : values_of<float>(*series, 0))
                values.push_back(value);
        else
            values = values_of<double>(*series, 0);
        for (const std::size_t nan : {1, 5}) {
            EXPECT_TRUE(std::isnan(values[nan]));
            values[nan] = 0;
        }
        EXPECT_EQ(values, (std::vector<double>{1, 0, -kInfinity, kInfinity, kInfinity, 0, -1.5,
                                               -kInfinity}));
    }
    EXPECT_THAT(
        error_of([&] { open_series({legacy("float", "1 nan 3.4028234e38 1 1 1 1 1", "a")}); }),
        HasSubstr("cannot tell apart"));
}

std::string collection(const std::string& sets) {
    return "<VTKFile type=\"Collection\"><Collection>" + sets + "</Collection></VTKFile>";
}

TEST(Pvd, PutsItsFilesInTheOrderOfTheirTimes) {
    TestFolder folder;
    for (const char* name : {"a.vti", "b.vti", "c.vti"})
        folder.write(name, read_file(kFolder / "ascii.vti"));
    const auto series = open_series(
        {folder.write("s.pvd", collection(R"(<DataSet timestep="10" file="a.vti"/>)"
                                          R"(<DataSet timestep="9" file="b.vti"/>)"
                                          R"(<DataSet timestep="-1e1" file="c.vti"/>)"))});
    EXPECT_EQ(series->info().times, (std::vector<double>{-10, 9, 10}));
    EXPECT_EQ(series->info().sources, (std::vector<std::string>{"c.vti", "b.vti", "a.vti"}));
}

/// A block of float, with the x coordinate as values, from vertex `begin` of that many along x.
std::string block(int begin, int count, const char* origin = "0 5 -1") {
    const std::string extent =
        std::to_string(begin) + " " + std::to_string(begin + count - 1) + " 0 2 0 2";
    std::string values;
    for (int i = 0; i < 9; ++i)
        for (int x = 0; x < count; ++x)
            values += std::to_string(begin + x) + " ";
    return "<VTKFile type='ImageData'><ImageData WholeExtent='" + extent + "' Origin='" + origin +
           "' Spacing='2 1 1'><Piece Extent='" + extent +
           "'><PointData><DataArray type='Float32' Name='x' format='ascii'>" + values +
           "</DataArray></PointData></Piece></ImageData></VTKFile>";
}

TEST(Pvd, PutsThePartsOfAStepTogether) {
    TestFolder folder;
    folder.write("a.vti", block(3, 4)), folder.write("b.vti", block(6, 3)),
        folder.write("c.vti", block(10, 2));
    folder.write("d.vti", block(6, 3, "0.5 5 -1"));
    const auto part = [](const char* time, const char* number, const char* file) {
        return std::string("<DataSet timestep='") + time + "' part='" + number + "' file='" + file +
               "'/>";
    };
    const auto series = open_series(
        {folder.write("s.pvd", collection(part("1", "0", "a.vti") + part("2", "1", "a.vti") +
                                          part("1", "1", "b.vti") + part("2", "0", "b.vti")))});
    EXPECT_EQ(series->info().grid.vertices, (std::array<std::uint32_t, 3>{6, 3, 3}));
    EXPECT_EQ(series->info().grid.origin, glm::dvec3(6, 5, -1));
    EXPECT_EQ(series->info().times, (std::vector<double>{1, 2}));
    for (const std::size_t step : {1, 0}) {
        const auto values = values_of<float>(*series, step);
        for (std::size_t i = 0; i < values.size(); ++i)
            ASSERT_EQ(values[i], 3 + i % 6);
    }
    const auto message = [&](const std::string& sets) {
        return error_of([&] { open_series({folder.write("s.pvd", collection(sets))}); });
    };
    EXPECT_THAT(message(part("1", "0", "a.vti") + part("1", "1", "c.vti")),
                HasSubstr("leave vertices of 9 x 3 x 3"));
    EXPECT_THAT(message(part("1", "0", "a.vti") + part("1", "1", "d.vti")),
                HasSubstr("d.vti: begins 3.25 cells"));
    EXPECT_THAT(message(part("1", "0", "a.vti") + part("2", "0", "b.vti")),
                HasSubstr("dimensions"));
}

TEST(Pvd, LeavesOutLastStepsThatAreNotThere) {
    TestFolder folder;
    for (const char* name : {"a.vti", "b.vti"})
        folder.write(name, read_file(kFolder / "ascii.vti"));
    const std::string sets = R"(<DataSet timestep="1" file="a.vti"/>)"
                             R"(<DataSet timestep="2" file="b.vti"/>)";
    const auto open = [&](const std::string& more) {
        return open_series({folder.write("s.pvd", collection(sets + more))});
    };
    const auto series = open(R"(<DataSet timestep="3" file="c.vti"/>)");
    EXPECT_THAT(series->info().times, testing::ElementsAre(1, 2));
    EXPECT_THAT(series->info().notes,
                testing::Contains("s.pvd names 3 files, of which the last 1 is not there, c.vti "
                                  "and on: left out"));
    EXPECT_THAT(error_of([&] { open(R"(<DataSet timestep="2" part="1" file="c.vti"/>)"); }),
                HasSubstr("c.vti: there is no such file"))
        << "a part of a step";
}

TEST(Pvd, RefusesMissingFiles) {
    TestFolder folder;
    for (const char* name : {"a.vti", "b.vti"})
        folder.write(name, read_file(kFolder / "ascii.vti"));
    const auto message = [&](const std::string& sets) {
        return error_of([&] { open_series({folder.write("s.pvd", collection(sets))}); });
    };
    EXPECT_THAT(message(R"(<DataSet timestep="1" file="c.vti"/>)"),
                HasSubstr("c.vti: there is no such file"));
    EXPECT_THAT(message(""), HasSubstr("empty collection"));
    EXPECT_THAT(error_of([&] { open_series({folder.write("t.pvd", "not xml")}); }),
                HasSubstr("t.pvd"));
}

} // namespace
} // namespace isochron::index
