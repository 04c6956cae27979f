// Folders as users have them: one series beside other files, or several, which are listed.
#include "index/readers/formats/open_series.h"
#include "index/readers/process/reader_pool.h"
#include "tests/support/reader_fixtures.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A folder with files in folders.
class UsersFolder : public testing::Test {
  protected:
    fs::path write(const std::string& name, const std::string& content) {
        fs::create_directories((folder_.path() / name).parent_path());
        return folder_.write(name, content);
    }
    /// A volume of 2 x 2 x 2 bytes of one value.
    fs::path nrrd(const std::string& name, char value) {
        return write(name, "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n\n" +
                               std::string(8, value));
    }
    std::vector<std::string> sources(const fs::path& path, const ReadOptions& options = {}) {
        return open_series({path}, options)->info().sources;
    }
    std::vector<std::string> notes(const std::vector<fs::path>& files) {
        return open_series(files)->info().notes;
    }

    TestFolder folder_;
};

TEST_F(UsersFolder, IsReadAsTheSeriesThatItHolds) {
    nrrd("Größe 10.NRRD", 'c');
    nrrd("Größe 9.NRRD", 'b');
    write("readme.txt", "?");
    write("run.log", "NRRD?");
    write(".hidden_8.nrrd", "");
    fs::create_symlink("nowhere", folder_.path() / "Größe 11.NRRD");
    const auto series = open_series({folder_.path()});
    EXPECT_THAT(series->info().sources, ElementsAre("Größe 9.NRRD", "Größe 10.NRRD"));
    EXPECT_EQ(values_of<std::uint8_t>(*series, 1), std::vector<std::uint8_t>(8, 'c'));
    EXPECT_THAT(series->info().notes, IsEmpty());
}

/// Each reader opens all places that it may read: a reader for each link would open as many as the
/// square of the links. `ln -s`, git-annex and DataLad make such folders.
TEST_F(UsersFolder, OfLinksIsReadByTheReaderThatReadsTheFirst) {
    constexpr std::size_t kLinks = 24;
    const auto write_links = [&](const std::string& to) {
        std::string list;
        for (std::size_t i = 0; i < kLinks; ++i) {
            const fs::path file = write(
                fmt::format("{}_store/{}/t.vtk", to, i),
                fmt::format("# vtk DataFile Version 3.0\n{}\nASCII\nDATASET STRUCTURED_POINTS\n"
                            "DIMENSIONS 2 2 2\nORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA 8\n"
                            "SCALARS v float\nLOOKUP_TABLE default\n1 2 3 4 5 6 7 {}\n",
                            i, i));
            const std::string name = fmt::format("t_{}.vtk", i);
            fs::create_directories(folder_.path() / to);
            fs::create_symlink(file, folder_.path() / to / name);
            list += fmt::format(R"({}{{"name": "{}", "time": {}}})", i ? ", " : "", name, i);
        }
        return write(to + "/all.vtk.series", R"({"files": [)" + list + "]}");
    };
    const auto readers_for = [](const std::vector<fs::path>& given) {
        const std::size_t before = readers_of_this_process().started();
        const auto series = open_series(given);
        for (std::size_t step = 0; step < kLinks; ++step)
            EXPECT_EQ(values_of<float>(*series, step).back(), static_cast<float>(step));
        return readers_of_this_process().started() - before;
    };
    const fs::path list = write_links("listed"), alone = write_links("links");
    fs::remove(alone);
    EXPECT_LE(readers_for({list}), 1u);
    EXPECT_LE(readers_for({alone.parent_path()}), 1u);
    std::vector<fs::path> folders;
    for (std::size_t i = 0; i < kLinks; ++i) {
        const std::string name = fmt::format("t_{}.zarr", i);
        write(name + "/.zarray", R"({"zarr_format": 2, "shape": [2, 2, 2], "chunks": [2, 2, 2],
            "dtype": "<f4", "compressor": null, "fill_value": 0, "order": "C", "filters": null})");
        folders.push_back(folder_.path() / name);
        const std::vector<float> values(8, static_cast<float>(i));
        write(name + "/0.0.0", text_of(values));
    }
    EXPECT_LE(readers_for(folders), 1u);
}

TEST_F(UsersFolder, MayHaveAFolderForEachStep) {
    for (const char* step : {"2", "10", "1"})
        nrrd(std::string("run/step_") + step + "/rho.nrrd", *step);
    const auto series = open_series({folder_.path() / "run"});
    ASSERT_EQ(series->info().steps(), 3u);
    EXPECT_EQ(values_of<std::uint8_t>(*series, 1), std::vector<std::uint8_t>(8, '2'));
}

// A list of pieces names files by their ends alone.
TEST_F(UsersFolder, MayHoldValuesWithoutAnExtensionBesideAListOfPieces) {
    nrrd("output", 'a');
    write("piece.vti", "?");
    write("pieces.pvti", "?");
    EXPECT_THAT(error_of([&] { open_series({folder_.path()}); }),
                AllOf(HasSubstr("several series or files"), HasSubstr("output'"),
                      HasSubstr("pieces.pvti'"), Not(HasSubstr("piece.vti'"))));
}

TEST_F(UsersFolder, OfOneSeriesSaysWhichFileItLeavesOut) {
    nrrd("a1.nrrd", 'a');
    nrrd("a2.nrrd", 'b');
    nrrd("mask.nrrd", 'm');
    const auto series = open_series({folder_.path()});
    EXPECT_THAT(series->info().sources, ElementsAre("a1.nrrd", "a2.nrrd"));
    EXPECT_THAT(series->info().notes,
                ElementsAre(AllOf(HasSubstr("left out of"), HasSubstr(": mask.nrrd"))));
}

TEST_F(UsersFolder, OfSeveralSeriesListsThem) {
    for (const char* name : {"a1.nrrd", "a2.nrrd", "b1.nrrd", "b2.nrrd", "b3.nrrd"})
        nrrd(name, 'v');
    const std::string message = error_of([&] { open_series({folder_.path()}); });
    EXPECT_THAT(message, AllOf(HasSubstr("/a*.nrrd' (2 files)"), HasSubstr("/b*.nrrd' (3 files)")));
    EXPECT_EQ(message.find('\n'), message.npos);
}

TEST_F(UsersFolder, CountsNoFilesThatOthersName) {
    for (const char* step : {"1", "2"}) {
        const std::string name = std::string("v") + step;
        write(name + ".raw", std::string(8, *step));
        write(name + ".mhd", "NDims = 3\nDimSize = 2 2 2\nElementType = MET_UCHAR\n"
                             "ElementDataFile = " +
                                 name + ".raw\n");
    }
    EXPECT_THAT(sources(folder_.path()), ElementsAre("v1.mhd", "v2.mhd"));
    write("all.vti.series", R"({"files": [{"name": "v2.mhd", "time": 1}]})");
    EXPECT_THAT(sources(folder_.path()), ElementsAre("v2.mhd"));
    write("all2.vti.series", R"({"files": [{"name": "v1.mhd", "time": 1}]})");
    EXPECT_THAT(error_of([&] { open_series({folder_.path()}); }), HasSubstr("several series"));
}

TEST_F(UsersFolder, HasExodusOnlyWhereTheContentIsThat) {
    nrrd("a1.nrrd", 'a');
    write("run.e", "errors: none");
    EXPECT_THAT(sources(folder_.path()), ElementsAre("a1.nrrd"));
    EXPECT_THAT(error_of([&] { open_series({folder_.path() / "run.e"}); }),
                HasSubstr("unknown format"));
    write("mesh.e", "CDF\x01 and then nothing");
    EXPECT_THAT(error_of([&] { open_series({folder_.path() / "mesh.e"}); }),
                HasSubstr("a mesh, expected a regular grid"));
}

TEST_F(UsersFolder, OfRawValuesTakesWhatIsAsLargeAsSaid) {
    write("d1.bin", std::string(8, 'a'));
    write("d2.bin", std::string(8, 'b'));
    write("info.json", "{}");
    EXPECT_THAT(error_of([&] { open_series({folder_.path()}); }),
                HasSubstr("a folder without a file of values"));
    ReadOptions options;
    options.dims = {{2, 2, 2}};
    options.type = ValueType::u8;
    EXPECT_THAT(sources(folder_.path(), options), ElementsAre("d1.bin", "d2.bin"));
}

TEST_F(UsersFolder, FormatIsToldByTheFirstBytesWhereTheNameDoesNot) {
    EXPECT_THAT(sources(nrrd("wrfout_2020-01-01_00:00:00", 'a')),
                ElementsAre("wrfout_2020-01-01_00:00:00"));
    EXPECT_THAT(error_of([&] { open_series({write("plot_0001", "CDF\x01 cut")}); }),
                AllOf(HasSubstr("plot_0001"), testing::Not(HasSubstr("unknown format"))));
    EXPECT_THAT(
        error_of([&] { open_series({write("chk_0001", std::string("\x89HDF\r\n\x1a\n cut"))}); }),
        AllOf(HasSubstr("chk_0001"), testing::Not(HasSubstr("unknown format"))));
}

TEST_F(UsersFolder, MissingStepsAreSaid) {
    std::vector<fs::path> files{nrrd("a_1.nrrd", 'a'), nrrd("a_2.nrrd", 'b'),
                                nrrd("a_3.nrrd", 'c')};
    EXPECT_THAT(notes(files), IsEmpty());
    files.push_back(nrrd("a_5.nrrd", 'd'));
    EXPECT_THAT(notes(files), Contains(HasSubstr("not evenly spaced (5 follows 3)")));
    ReadOptions timed;
    timed.times_from_names = true;
    const auto series = open_series(files, timed);
    EXPECT_EQ(series->info().times, (std::vector<double>{1, 2, 3, 5}));
    EXPECT_THAT(series->info().notes, IsEmpty());
    EXPECT_THAT(notes({nrrd("b_010.nrrd", 'a'), nrrd("b_020.nrrd", 'b'), nrrd("b_030.nrrd", 'c')}),
                IsEmpty())
        << "every tenth is even";
}

TEST_F(UsersFolder, GapsAreWhereNumbersAreMissing) {
    const auto gaps = [&](const std::vector<std::string>& names, const ReadOptions& options = {}) {
        std::vector<fs::path> files;
        for (const std::string& name : names)
            files.push_back(nrrd(name + ".nrrd", 'a'));
        return open_series(files, options)->info().missing_after;
    };
    EXPECT_THAT(gaps({"a1", "a2", "a3", "a5", "a6", "a9"}), ElementsAre(2, 4));
    EXPECT_THAT(gaps({"a1", "a2", "a4"}), ElementsAre(1));
    EXPECT_THAT(gaps({"a1", "a5"}), IsEmpty()) << "how far apart steps are is not known";
    EXPECT_THAT(gaps({"b0.1", "b0.2", "b0.4"}), ElementsAre(1));
    EXPECT_THAT(gaps({"b0.3", "b0.7", "b1.0"}), IsEmpty()) << "thirds, rounded";
    EXPECT_THAT(gaps({"c0", "c10", "c20", "c25", "c30", "c40"}), IsEmpty()) << "one more step";
    EXPECT_THAT(gaps({"d/1/x1", "d/2/x2", "d/4/x4"}), ElementsAre(1)) << "folders count, too";
    EXPECT_THAT(gaps({"2020-01-30", "2020-01-31", "2020-02-01", "2020-02-03"}), ElementsAre(2));
    EXPECT_THAT(gaps({"m20191201", "m20200101", "m20200201", "m20200301"}), IsEmpty()) << "months";
    EXPECT_THAT(gaps({"m20191201", "m20200101", "m20200201", "m20200401"}), ElementsAre(2));
    ReadOptions options;
    options.times_from_names = true;
    EXPECT_THAT(gaps({"a1", "a2", "a3", "a5"}, options), IsEmpty()) << "the times tell";
    options = {};
    options.time_step = 0.5;
    EXPECT_THAT(gaps({"a1", "a2", "a3", "a5"}, options), ElementsAre(2));
    options = {};
    options.steps = {1, 5, 2};
    EXPECT_THAT(gaps({"a1", "a2", "a3", "a4", "a5", "a6"}, options), IsEmpty());
    EXPECT_THAT(gaps({"a0", "a1", "a2", "a3", "a5", "a7", "a8"}, options), ElementsAre(1));
}

TEST_F(UsersFolder, TimesThatFilesStateTellOfGapsThemselves) {
    std::vector<fs::path> files;
    for (const char time : {'1', '2', '4'}) {
        const std::string name = std::string("e") + time;
        write(name + ".raw", std::string(8, time));
        files.push_back(write(name + ".bov", std::string("TIME: ") + time +
                                                 ".5\nDATA_FILE: " + name +
                                                 ".raw\nDATA_SIZE: 2 2 2\nDATA_FORMAT: BYTE\n"));
    }
    const auto series = open_series(files);
    EXPECT_THAT(series->info().times, ElementsAre(1.5, 2.5, 4.5));
    EXPECT_THAT(series->info().missing_after, IsEmpty());
}

/// Arrays stand in another order in the second file: what was taken of the first is taken of all.
TEST_F(UsersFolder, HasFilesWhoseArraysStandInAnyOrder) {
    const auto vtk = [&](const std::string& name, const std::vector<std::string>& arrays) {
        std::string text = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_POINTS\n"
                           "DIMENSIONS 2 2 2\nORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA 8\n";
        for (const std::string& array : arrays)
            text += "SCALARS " + array + " float 1\nLOOKUP_TABLE default\n" +
                    (array == "p" ? "1 1 1 1 1 1 1 1\n" : "2 2 2 2 2 2 2 2\n");
        return write(name, text);
    };
    ReadOptions any;
    any.any_array = true;
    const auto series = open_series({vtk("a1.vtk", {"p", "q"}), vtk("a2.vtk", {"q", "p"})}, any);
    EXPECT_EQ(values_of<float>(*series, 1), std::vector<float>(8, 1.0f));
}

/// Files without times, whose numbers are their steps.
TEST_F(UsersFolder, HasFilesThatAreNotOpenedWhereStepsLeavesThemOut) {
    for (const char number : {'0', '1', '2', '4', '5'})
        nrrd(std::string("t") + number + ".nrrd", number);
    const auto size = std::filesystem::file_size(folder_.path() / "t0.nrrd");
    write("t3.nrrd", "NRRD0004\ntype: none\n\n" + std::string(size - 21, '3'));
    ReadOptions options;
    for (const auto& [steps, expected] :
         {std::pair{std::array<std::uint64_t, 3>{0, 5, 2},
                    std::vector{"t0.nrrd", "t2.nrrd", "t4.nrrd"}},
          std::pair{std::array<std::uint64_t, 3>{4, 5, 1}, std::vector{"t4.nrrd", "t5.nrrd"}}}) {
        options.steps = steps;
        const auto series = open_series({folder_.path()}, options);
        EXPECT_THAT(series->info().sources, testing::ElementsAreArray(expected));
        EXPECT_EQ(values_of<std::uint8_t>(*series, 1).front(), expected[1][1]);
        EXPECT_EQ(series->info().times[0], static_cast<double>(steps[0]));
    }
    options.steps = {{1, 5, 2}};
    EXPECT_THAT(error_of([&] { open_series({folder_.path()}, options); }), HasSubstr("t3.nrrd"));
    options.steps = {{0, 6, 2}};
    EXPECT_THAT(error_of([&] { open_series({folder_.path()}, options); }),
                HasSubstr("--steps 0:6:2, expected steps of 0:5"));
    // A file of two steps, so that those behind it have other numbers.
    for (const char number : {'0', '1', '2', '3'})
        write(std::string("raw/t") + number + ".raw", std::string(number == '1' ? 16 : 8, number));
    ReadOptions raw;
    raw.dims = {{2, 2, 2}};
    raw.type = ValueType::u8;
    raw.steps = {{2, 4, 2}};
    const auto series = open_series({folder_.path() / "raw"}, raw);
    EXPECT_EQ(values_of<std::uint8_t>(*series, 0).front(), '1');
    EXPECT_EQ(values_of<std::uint8_t>(*series, 1).front(), '3');
}

} // namespace
} // namespace isochron::index
