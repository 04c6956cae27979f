// The table of formats: what names and first bytes tell, and that each row can be used.
#include "index/readers/formats/format.h"
#include "index/readers/formats/open_series.h"

#include "index/readers/formats/foreign_file.h"
#include "tests/support/reader_fixtures.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>
#include <set>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

std::string_view name_of_format(const fs::path& path) {
    const KnownFile file = known_file(path);
    return file.format ? file.format->name : "";
}

TEST(Format, IsToldByTheEndOfAName) {
    const std::map<std::string, std::string_view> expected{{"run.pvd", "pvd"},
                                                           {"run.vti.series", "json series"},
                                                           {"T_0030.VTI", "vti"},
                                                           {"brain.nii.gz", "nifti"},
                                                           {"brain.img", "nifti"},
                                                           {"a.nc", "netcdf"},
                                                           {"pieces.pvti", "vtk data"},
                                                           {"a.btf", "tiff"},
                                                           {"a.vtkhdf", "hdf5"},
                                                           {"a.zarr/zarr.json", "zarr"},
                                                           {"a.raw", "raw"},
                                                           {"IM.DCM", "dicom"},
                                                           {"system/controlDict", "mesh"},
                                                           {"a.xmf", "xdmf"},
                                                           {"notes.e", ""},
                                                           {"notes.txt", ""}};
    for (const auto& [name, format] : expected)
        EXPECT_EQ(name_of_format("/nowhere/" + name), format) << name;
}

TEST(Format, IsToldByFirstBytesWhereNoNameDoes) {
    const TestFolder folder;
    const std::string hdf5 = "\x89HDF\r\n\x1a\n";
    const std::map<std::string, std::string> contents{
        {"hdf5", hdf5 + std::string(60000, '.')},
        {"netcdf", hdf5 + std::string(60000, '.') + "_NCProperties"},
        {"nrrd", "NRRD0004\n"},
        {"vtk", "# vtk DataFile Version 3.0\n"},
        {"dicom", std::string(128, '\0') + "DICM"},
        {"", std::string(128, '\0') + "DICK"}};
    for (const auto& [format, content] : contents)
        EXPECT_EQ(name_of_format(folder.write("output", content)), format);
    EXPECT_EQ(name_of_format(folder.write("classic", "CDF\x02")), "netcdf");
    EXPECT_EQ(name_of_format(folder.write("run.e", "CDF\x02")), "mesh");
    EXPECT_EQ(name_of_format(folder.write("run.e", hdf5)), "mesh");
    EXPECT_EQ(name_of_format(folder.write("Header", "HyperCLaw-V1.1\n")), "mesh");
    EXPECT_EQ(name_of_format(folder.write("header", "HyperCLaw-V1.1\n")), "");
}

/// The first bytes of a file of each format that has a signature.
std::map<std::string, std::string> signatures() {
    const std::string hdf5 = "\x89HDF\r\n\x1a\n", block(512, '.');
    const auto number = [](std::int32_t value) {
        return std::string(reinterpret_cast<const char*>(&value), sizeof value);
    };
    std::string mrc(1024, '\0');
    for (const auto& [at, value] :
         {std::pair(0, 6), {4, 5}, {8, 4}, {12, 2}, {64, 1}, {68, 2}, {72, 3}})
        mrc.replace(static_cast<std::size_t>(at), 4, number(value));
    mrc.replace(208, 4, "MAP ");
    return {{"hdf5", hdf5},
            {"hdf5 behind a block", "MATLAB 7.3 MAT-file" + block.substr(19) + hdf5},
            {"netcdf", "CDF\x01"},
            {"netcdf of 64 bits", "CDF\x02"},
            {"nrrd", "NRRD0005\n"},
            {"nifti", number(348) + std::string(340, '\0') + std::string("n+1\0", 4)},
            {"nifti 2", number(540) + std::string("n+2\0\r\n\x1a\n", 8)},
            {"vtk", "# vtk DataFile Version 3.0\n"},
            {"vti", "<?xml version='1.0'?>\n<VTKFile type='ImageData' version='0.1'>"},
            {"vtk data", "<VTKFile version=\"0.1\" type=\"RectilinearGrid\">"},
            {"pvd", "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\">"},
            {"xdmf", "<?xml version=\"1.0\" ?>\n<Xdmf Version=\"3.0\">"},
            {"dicom", std::string(128, '\0') + "DICM"},
            {"tiff", std::string("II*\0", 4)},
            {"tiff, big-endian", std::string("MM\0*", 4)},
            {"tiff beyond 4 GB", std::string("II+\0", 4)},
            {"mrc", mrc}};
}

// Each content under each end: it is of its format, but for containers under the ends of formats
// that are made of them, for lists of steps under any name, and for raw values, which may begin in
// any way.
TEST(Format, IsToldByContentBeforeTheName) {
    const std::map<std::string_view, std::set<std::string_view>> containers{
        {"netcdf", {"netcdf", "hdf5"}},
        {"mesh", {"netcdf", "hdf5"}},
        {"vtk data", {"vtk data", "vti", "pvd"}}};
    const TestFolder folder;
    std::size_t cells = 0;
    for (const auto& [content, bytes] : signatures()) {
        const std::string_view told =
            content == "vtk data"
                ? content
                : std::string_view(content).substr(0, content.find_first_of(" ,"));
        for (const Format& format : all_formats())
            for (const NameEnd& end : format.ends) {
                const fs::path file = folder.write("file" + std::string(end.end), bytes);
                const auto held = containers.find(format.name);
                const bool is_held = held != containers.end() && held->second.contains(told);
                FileStart start(file);
                const bool by_name =
                    format.headerless || (is_held && (!end.only_if || end.only_if(start)));
                EXPECT_EQ(name_of_format(file), by_name ? format.name : told)
                    << content << " under " << end.end;
                fs::remove(file);
                ++cells;
            }
        EXPECT_EQ(name_of_format(folder.write("output", bytes)), told) << content;
    }
    EXPECT_GT(cells, 900u);
}

TEST(Format, OfAFolderIsThatOfTheFileThatDescribesIt) {
    const TestFolder folder;
    fs::create_directories(folder.path() / "t_1.zarr");
    fs::create_directories(folder.path() / "plt00010");
    fs::create_directories(folder.path() / "plain");
    folder.write("t_1.zarr/.zarray", "{}");
    folder.write("plt00010/Header", "HyperCLaw-V1.1\n");
    folder.write("plain/Header", "of a text\n");
    const KnownFile zarr = known_file(folder.path() / "t_1.zarr");
    EXPECT_EQ(zarr.format, &format_named("zarr"));
    EXPECT_EQ(zarr.given, folder.path() / "t_1.zarr");
    EXPECT_EQ(zarr.path, folder.path() / "t_1.zarr/.zarray");
    EXPECT_EQ(name_of_format(folder.path() / "plt00010"), "mesh");
    EXPECT_EQ(name_of_format(folder.path() / "plain"), "");
}

// Dual files are TIFF by their name, and DICOM together.
TEST(Format, OfContentHoldsWhateverTheNameSays) {
    const TestFolder folder;
    const KnownFile dual = known_file(
        folder.write("scan.tif", std::string("II*\0", 4) + std::string(124, '\0') + "DICM"));
    EXPECT_EQ(dual.format, &format_named("tiff"));
    EXPECT_TRUE(is_of_format(format_named("dicom"), dual));
    EXPECT_FALSE(is_of_format(format_named("nrrd"), dual));
}

TEST(Format, EndsAreOffered) {
    EXPECT_TRUE(has_known_end("A.NII.GZ", false));
    EXPECT_TRUE(has_known_end("a.pvd", false));
    EXPECT_TRUE(has_known_end("a.zarr", true));
    EXPECT_FALSE(has_known_end("a.vti", true));
    EXPECT_FALSE(has_known_end("a.isochron", false));
    EXPECT_TRUE(known_extensions().starts_with(".pvd .series .vti .vtk "));
}

TEST(Formats, HaveNamesAndEndsOfTheirOwn) {
    std::set<std::string_view> names, ends;
    for (const Format& format : all_formats()) {
        EXPECT_TRUE(names.insert(format.name).second) << format.name;
        for (const NameEnd& each : format.ends)
            EXPECT_TRUE(ends.insert(each.end).second) << each.end;
    }
    for (const Format& format : all_formats())
        for (const NameEnd& each : format.ends)
            for (const std::string_view named : each.named)
                EXPECT_TRUE(ends.contains(named)) << each.end << " names " << named;
}

TEST(Formats, AreOpenedInOneWay) {
    for (const Format& format : all_formats())
        EXPECT_EQ((format.open != nullptr) + !format.reader.empty() + (format.list != nullptr), 1)
            << format.name;
}

// A reader that does not know the format ends, which is told otherwise than a file that it refuses.
TEST(Formats, AreKnownToTheirReaders) {
    const TestFolder folder;
    for (const Format& format : all_formats()) {
        if (format.reader.empty())
            continue;
        SCOPED_TRACE(format.name);
        const fs::path file = folder.write("a" + std::string(format.ends.front().end), "?");
        const std::string line = error_of([&] { open_in_format(format, file, {}); });
        EXPECT_THAT(line, HasSubstr(file.string()));
        if (line.find("not found beside the program") == line.npos) { // it needs a library
            EXPECT_THAT(line, Not(HasSubstr("its reader"))) << line;
        }
    }
}

} // namespace
} // namespace isochron::index
