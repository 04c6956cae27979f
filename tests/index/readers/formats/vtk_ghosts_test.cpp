// Ghosts and blanked points and cells of VTK's files are missing values; times from their fields.
#include "index/readers/formats/open_series.h"
#include "tests/support/reader_fixtures.h"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

namespace isochron::index {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kSide = 5; ///< vertices
constexpr int kCells = kSide - 1;

template <class Number>
std::string ascii_array(const std::string& type, const std::string& name, int count,
                        Number number) {
    std::string text = "<DataArray type='" + type + "' Name='" + name + "' format='ascii'>";
    for (int i = 0; i < count; ++i)
        text += std::to_string(number(i)) + " ";
    return text + "</DataArray>";
}

std::string image(const std::string& points, const std::string& cells,
                  const std::string& fields = "") {
    return "<VTKFile type='ImageData' version='0.1' byte_order='LittleEndian'><ImageData "
           "WholeExtent='0 4 0 4 0 4' Origin='0 0 0' Spacing='1 1 1'>" +
           fields + "<Piece Extent='0 4 0 4 0 4'><PointData>" + points + "</PointData><CellData>" +
           cells + "</CellData></Piece></ImageData></VTKFile>";
}

std::string values_at_points(const char* type = "Float32") {
    return ascii_array(type, "p", kSide * kSide * kSide, [](int i) { return i; });
}

std::string flags(int count, const std::set<int>& hidden, int flag) {
    return ascii_array("UInt8", "vtkGhostType", count,
                       [&](int i) { return hidden.contains(i) ? flag : 0; });
}

class VtkGhosts : public testing::Test {
  protected:
    std::unique_ptr<VolumeSeries> open(const std::string& text) const {
        return open_series({folder_.write("a.vti", text)});
    }

    /// Vertices whose value is missing; the others must be as they were stored.
    template <class T>
    static std::set<int> missing_in(VolumeSeries& series) {
        const std::vector<T> values = values_of<T>(series, 0);
        std::set<int> missing;
        for (int i = 0; i < kSide * kSide * kSide; ++i)
            if (std::isnan(values[i]))
                missing.insert(i);
            else
                EXPECT_EQ(values[i], static_cast<T>(i));
        return missing;
    }

    TestFolder folder_;
};

TEST_F(VtkGhosts, PointsThatAreFlaggedAreMissing) {
    const std::set<int> hidden{0, 7, 62, 124};
    for (const int flag : {1, 2, 3}) { // duplicate, hidden, both
        const auto series = open(image(values_at_points() + flags(125, hidden, flag), ""));
        EXPECT_EQ(missing_in<float>(*series), hidden);
        EXPECT_THAT(series->info().notes,
                    Contains("4 of 125 vertices are ghosts or blanked: their values are missing"));
    }
    const auto series = open(image(values_at_points() + flags(125, {}, 1), ""));
    EXPECT_EQ(missing_in<float>(*series), std::set<int>{});
    EXPECT_THAT(series->info().notes, IsEmpty());
}

TEST_F(VtkGhosts, IntegersWithFlagsBecomeNumbersThatCanBeMissing) {
    auto series = open(image(values_at_points("UInt8") + flags(125, {9}, 2), ""));
    EXPECT_EQ(missing_in<float>(*series), std::set<int>{9});
    series = open(image(values_at_points("Int32") + flags(125, {9}, 2), ""));
    EXPECT_EQ(missing_in<double>(*series), std::set<int>{9});
    EXPECT_THAT(series->info().notes, Contains(HasSubstr("i32 values converted to f64")));
}

// What must hold, whatever vertices are chosen for it: no cell that is flagged has eight values,
// and where flagged cells fill a box two cells thick all others keep theirs.
TEST_F(VtkGhosts, CellsThatAreFlaggedAreNeverActive) {
    std::set<int> half, alone{21}, layer;
    for (int cell = 0; cell < 64; ++cell) {
        if (cell % kCells < 2)
            half.insert(cell);
        if (cell / 16 == 3)
            layer.insert(cell);
    }
    for (const int flag : {1, 8, 32}) // duplicate, refined, hidden
        for (const std::set<int>& hidden : {half, alone, layer}) {
            const auto series = open(image(values_at_points(), flags(64, hidden, flag)));
            const std::set<int> missing = missing_in<float>(*series);
            for (int cell = 0; cell < 64; ++cell) {
                const int x = cell % 4, y = cell / 4 % 4, z = cell / 16;
                bool whole = true;
                for (int corner = 0; corner < 8; ++corner)
                    whole &= !missing.contains(
                        ((z + (corner >> 2)) * kSide + y + (corner >> 1 & 1)) * kSide + x +
                        (corner & 1));
                if (hidden.contains(cell))
                    EXPECT_FALSE(whole) << cell;
                else if (hidden != alone)
                    EXPECT_TRUE(whole) << cell;
            }
        }
    // Other flags of VTK's are no reason: high and low connectivity, exterior.
    const auto series = open(image(values_at_points(), flags(64, half, 2 | 4 | 16)));
    EXPECT_EQ(missing_in<float>(*series), std::set<int>{});
}

TEST_F(VtkGhosts, CountForNothingInMeansOfCells) {
    std::set<int> hidden;
    for (int cell = 0; cell < 64; ++cell)
        if (cell % 4 == 0)
            hidden.insert(cell);
    const auto series = open(image("", ascii_array("Float32", "q", 64, [](int cell) {
                                           return cell % 4 == 0 ? 1000 : 7;
                                       }) + flags(64, hidden, 32)));
    const std::vector<float> values = values_of<float>(*series, 0);
    for (int vertex = 0; vertex < 125; ++vertex)
        if (vertex % 5 == 0) // only flagged cells are around it
            EXPECT_TRUE(std::isnan(values[vertex])) << vertex;
        else
            EXPECT_EQ(values[vertex], 7.f) << vertex;
    EXPECT_THAT(series->info().notes, Contains(HasSubstr("16 of 64 cells are ghosts")));
}

TEST_F(VtkGhosts, OfLegacyFilesToo) {
    std::string text = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_POINTS\n"
                       "DIMENSIONS 5 5 5\nORIGIN 0 0 0\nSPACING 1 1 1\n"
                       "FIELD FieldData 1\nTIME 1 1 double\n12.5\n"
                       "POINT_DATA 125\nSCALARS p float 1\nLOOKUP_TABLE default\n";
    for (int i = 0; i < 125; ++i)
        text += std::to_string(i) + "\n";
    text += "FIELD FieldData 1\nvtkGhostLevels 1 125 unsigned_char\n";
    for (int i = 0; i < 125; ++i)
        text += i == 31 ? "1\n" : "0\n";
    const auto series = open_series({folder_.write("a.vtk", text)});
    EXPECT_EQ(missing_in<float>(*series), std::set<int>{31});
    EXPECT_EQ(series->info().times, std::vector<double>{12.5});
    EXPECT_THAT(series->info().notes, Contains("times are those of the field TIME"));
}

TEST(VtkTimes, AreReadFromTheFieldsOfOthers) {
    TestFolder folder;
    const auto field = [](const char* name, int time) {
        return std::string("<FieldData><DataArray type='Int32' Name='") + name +
               "' NumberOfTuples='1' format='ascii'>" + std::to_string(time) +
               "</DataArray></FieldData>";
    };
    std::vector<std::filesystem::path> files;
    for (int step = 0; step < 3; ++step)
        files.push_back(folder.write("t" + std::to_string(step) + ".vti",
                                     image(values_at_points(), "", field("TimeStep", 30 * step))));
    const auto series = open_series(files);
    EXPECT_EQ(series->info().times, (std::vector<double>{0, 30, 60}));
    EXPECT_THAT(series->info().notes, Contains("times are those of the field TimeStep"));
}

TEST(TimesFromNames, AreTheLastNumberOfEach) {
    TestFolder folder;
    ReadOptions options;
    options.times_from_names = true;
    const auto times_of = [&](const std::vector<std::string>& names) {
        std::vector<std::filesystem::path> files;
        for (const std::string& name : names)
            files.push_back(folder.write(name, image(values_at_points(), "")));
        return open_series(files, options)->info().times;
    };
    EXPECT_EQ(times_of({"t_0030.vti", "t_0100.vti"}), (std::vector<double>{30, 100}));
    EXPECT_EQ(times_of({"run2_0.25s.vti", "run2_0.5s.vti"}), (std::vector<double>{0.25, 0.5}));
    EXPECT_THAT(error_of([&] { times_of({"t.vti"}); }), HasSubstr("no number in its name"));
    EXPECT_THAT(error_of([&] { times_of({"a_5.vti", "b_05.vti"}); }), HasSubstr("has the same"));
    options.time_step = 1;
    EXPECT_THAT(error_of([&] { times_of({"t_1.vti"}); }), HasSubstr("expected one of the two"));
}

} // namespace
} // namespace isochron::index
