// Which headers of VTK image files have the same hash, so that a file need not be opened.
#include "index/readers/formats/series/vti_header_hash.h"

#include "index/error.h"
#include "index/readers/formats/open_series.h"
#include "tests/support/test_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

namespace isochron::index {
namespace {

struct Image {
    std::string spacing = "1 1 1", name = "a", type = "UInt8", range = "7",
                values = "0 1 2 3 4 5 6 7";
    std::string unit = "mm", norm = "2.5", more = {}, compressor = {};

    std::string text() const {
        return fmt::format(
            R"(<?xml version="1.0"?>
<VTKFile type="ImageData" version="0.1" byte_order="LittleEndian"{}><ImageData WholeExtent="0 1 0 1 0 1"
 Origin="0 0 0" Spacing="{}">{}<Piece Extent="0 1 0 1 0 1"><PointData Scalars="{}"><DataArray type="{}"
 Name="{}" format="ascii" RangeMin="0" RangeMax="{}">{}<InformationKey
 name="L2_NORM_RANGE" location="vtkDataArray" length="2"><Value index="0">0</Value><Value index="1">{}</Value></InformationKey>
<InformationKey name="UNITS_LABEL" location="vtkDataArray">{}</InformationKey>
</DataArray></PointData></Piece></ImageData></VTKFile>)",
            compressor, spacing, more, name, type, name, range, values, norm, unit);
    }
    std::optional<std::uint64_t> head() const { return vti_header_hash(text(), text().size()); }
};

TEST(VtiHeaderHash, IsTheSameWhateverTheValuesAre) {
    const auto head = Image{}.head();
    ASSERT_TRUE(head);
    EXPECT_EQ((Image{.range = "2000", .values = "9 9 9 9 9 9 9 2000", .norm = "77"}).head(), head);
}

TEST(VtiHeaderHash, DiffersWithAllThatDescribesTheFile) {
    const auto head = Image{}.head();
    for (const Image& other :
         {Image{.spacing = "1 1 2"}, Image{.name = "b"}, Image{.type = "Int8"}, Image{.unit = "m"},
          Image{.compressor = R"( compressor="vtkZLibDataCompressor")"}})
        EXPECT_NE(other.head(), head) << other.text();
}

TEST(VtiHeaderHash, TellsNothingWhereATimeOrAnotherGridMayStand) {
    EXPECT_FALSE(
        (Image{.more = R"(<FieldData><DataArray type="Float64" Name="TimeValue" format="ascii">3
</DataArray></FieldData>)"})
            .head());
    std::string text = Image{}.text();
    EXPECT_FALSE(vti_header_hash(text.substr(0, text.size() - 5), text.size())) << "cut off";
    EXPECT_FALSE(vti_header_hash("<!-- " + text, text.size())) << "comments hide tags";
    text.replace(text.find("ImageData"), 9, "RectilinearGrid");
    EXPECT_FALSE(vti_header_hash(text, text.size())) << "its coordinates are values";
    EXPECT_FALSE(vti_header_hash("", 0));
    EXPECT_FALSE(vti_header_hash("NRRD0004\n", 9));
    EXPECT_FALSE(header_hash_of_file(std::filesystem::path("/no/such/file"), 0));
}

TEST(VtiHeaderHash, OfAppendedValuesTheFileIsAsLongAsTheFirst) {
    const std::string text =
        R"(<VTKFile type="ImageData"><ImageData WholeExtent="0 1 0 1 0 1"><Piece><PointData>
<DataArray Name="a" format="appended" offset="0"/></PointData></Piece></ImageData><AppendedData encoding="raw">_)";
    ASSERT_TRUE(vti_header_hash(text, 1000));
    EXPECT_NE(vti_header_hash(text, 1000), vti_header_hash(text, 999)) << "shorter: cut off";
    std::string packed = text;
    packed.insert(8, " compressor=\"vtkZLibDataCompressor\"");
    EXPECT_EQ(vti_header_hash(packed, 1000), vti_header_hash(packed, 999));
}

TEST(VtiHeaderHash, ASeriesIsWhatItIsWhenEveryFileIsOpened) {
    test_support::TestFolder folder;
    std::vector<std::filesystem::path> files;
    for (int i = 0; i < 4; ++i) {
        files.push_back(folder.path() / fmt::format("s_{}.vti", i));
        folder.write(files.back().filename().string(),
                     Image{.values = fmt::format("{} 1 2 3 4 5 6 7", i)}.text());
    }
    int told = 0;
    const auto series = open_series(files, {}, [&](std::string_view, double) { ++told; });
    EXPECT_EQ(told, 0) << "few files are opened at once";
    ASSERT_EQ(series->info().times.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        std::vector<std::byte> values(8);
        series->read(i, values);
        EXPECT_EQ(static_cast<std::size_t>(values[0]), i);
    }
    folder.write("s_2.vti", Image{.spacing = "1 1 2"}.text());
    EXPECT_THROW(open_series(files, {}), Error);
    folder.write("s_2.vti", "<VTKFile type=\"ImageData\">");
    EXPECT_THROW(open_series(files, {}), Error);
}

TEST(VtiHeaderHash, ManyFilesSayHowFarTheirOpeningIs) {
    test_support::TestFolder folder;
    std::vector<std::filesystem::path> files;
    for (int i = 0; i < 1000; ++i) {
        files.push_back(folder.path() / fmt::format("s_{}.vti", i));
        folder.write(files.back().filename().string(), Image{}.text());
    }
    std::vector<double> fractions;
    const auto series = open_series(files, {}, [&](std::string_view phase, double fraction) {
        EXPECT_EQ(phase, "opening files");
        fractions.push_back(fraction);
    });
    EXPECT_EQ(series->info().times.size(), 1000u);
    ASSERT_EQ(fractions.size(), 16u);
    EXPECT_TRUE(std::ranges::is_sorted(fractions));
}

} // namespace
} // namespace isochron::index
