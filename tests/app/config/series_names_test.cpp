// Series among the names of files.
#include "app/config/series_names.h"

#include "tests/support/test_folder.h"

#include <gmock/gmock.h>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

TEST(SeriesNames, FilesThatDifferInOneNumberAreASeries) {
    const auto found = series_among(
        Names{"a.nrrd", "run2_t10.vti", "run2_t8.vti", "run2_t9.vti", "step.1.raw", "step.2.raw"});
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].pattern, "run2_t[0-9]*.vti");
    EXPECT_EQ(found[0].first, "run2_t8.vti");
    EXPECT_EQ(found[0].last, "run2_t10.vti");
    EXPECT_EQ(found[0].files, 3u);
    EXPECT_EQ(found[1].pattern, "step.[0-9]*.raw");
}

TEST(SeriesNames, APatternMatchesItsFilesOnly) {
    EXPECT_TRUE(series_among(Names{"t1.vti", "t2.vti", "t3_mask.vti"}).empty())
        << "t[0-9]*.vti would have the mask too";
    const auto odd = series_among(Names{"t[x]1.vti", "t[x]2.vti", "tx9.vti"});
    ASSERT_EQ(odd.size(), 1u);
    EXPECT_EQ(odd[0].pattern, "t[[]x][0-9]*.vti");
    EXPECT_TRUE(series_among(Names{"only1.vti", "other.vti"}).empty());
}

TEST(SeriesNames, AreSaidAsPeopleReadThem) {
    for (const auto& [data, said] :
         {std::pair("/d/case_[0-9]*.vti", "case_*.vti"), std::pair("t[[]x][0-9]*.vti", "t[x]*.vti"),
          std::pair("/d/run_[0-9]*/p.nii", "p.nii"), std::pair("a[*]b[?].raw", "a*b?.raw"),
          std::pair("flow.isochron", "flow.isochron"), std::pair("t*.vti", "t*.vti"),
          std::pair("[[", "[[")})
        EXPECT_EQ(said_name(data), said);
}

TEST(SeriesNames, FilesOfAFolderHaveOneNameIfTheyAreAllThatMatch) {
    const test_support::TestFolder folder;
    fs::create_directory(folder.path() / "b[0]");
    for (const char* name : {"t1.vti", "t2.vti", "b[0]/t1.vti", "b[0]/t2.vti"})
        folder.write(name, "");
    const auto one_name = [&](const Names& names) {
        std::vector<fs::path> files;
        for (const std::string& name : names)
            files.push_back(folder.path() / name);
        return one_name_of(files);
    };
    EXPECT_EQ(one_name({"t1.vti"}), folder.path() / "t1.vti");
    EXPECT_EQ(one_name({"t2.vti", "t1.vti"}), folder.path() / "t[0-9]*.vti");
    EXPECT_EQ(one_name({"b[0]/t1.vti", "b[0]/t2.vti"}), folder.path() / "b[[]0]" / "t[0-9]*.vti");
    EXPECT_FALSE(one_name({"t1.vti", "b[0]/t1.vti"}));
    folder.write("t3.vti", "");
    EXPECT_FALSE(one_name({"t1.vti", "t2.vti"}));
    EXPECT_FALSE(one_name({}));
}

} // namespace
} // namespace isochron::app
