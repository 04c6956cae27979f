// What `info` says of files of values, and paths within files.
#include "app/indexing/build_arguments.h"
#include "app/indexing/file_patterns.h"

#include "index/error.h"
#include "tests/support/as_words.h"
#include "tests/support/child_process.h"
#include "tests/support/paths.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace isochron::app {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(PathWithin, IsTakenOffTheName) {
    std::vector<std::string> names = as_words("run.h5:/fields/rho b.h5:/fields/rho c.h5");
    EXPECT_EQ(take_path_within(names), "/fields/rho");
    EXPECT_EQ(names, (std::vector<std::string>{"run.h5", "b.h5", "c.h5"}));
    EXPECT_EQ(take_path_within(names), std::nullopt);
    std::vector<std::string> two{"a.h5:/x", "b.h5:/y"};
    EXPECT_THROW(take_path_within(two), index::Error);
}

TEST(PathWithin, IsNotTakenOffAFileThatIsThere) {
    const TestFolder folder;
    std::filesystem::create_directory(folder.path() / "odd:");
    std::vector<std::string> names{folder.write("odd:/x", "?").string()};
    EXPECT_EQ(take_path_within(names), std::nullopt);
}

TEST(PathWithin, GoesNotWithAnArray) {
    BuildArguments arguments;
    arguments.files = {"run.h5:/rho"};
    EXPECT_EQ(with_path_within(arguments).read.array, "/rho");
    arguments.read.array = "u";
    EXPECT_THROW(with_path_within(arguments), UsageError);
}

class SourceInfo : public testing::Test {
  protected:
    ChildResult info(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "info");
        return run(arguments);
    }
    ChildResult run(const std::vector<std::string>& arguments) const {
        return run_child(test_support::binary_root() + "/isochron", arguments, folder_.path());
    }
    TestFolder folder_;
};

TEST_F(SourceInfo, SaysWhereASpacingIsAMean) {
    folder_.write(
        "r.vtk", "# vtk DataFile Version 3.0\nr\nASCII\nDATASET RECTILINEAR_GRID\n"
                 "DIMENSIONS 4 2 3\nX_COORDINATES 4 float\n0 1 3 9\n"
                 "Y_COORDINATES 2 float\n0 2\nZ_COORDINATES 3 float\n0 5 10\n"
                 "POINT_DATA 24\nSCALARS s float 1\nLOOKUP_TABLE default\n" +
                     [] {
                         std::string values;
                         for (int i = 0; i < 24; ++i)
                             values += std::to_string(i) + " ";
                         return values + "\n";
                     }());
    const ChildResult text = info({"r.vtk"});
    ASSERT_EQ(text.status, 0) << text.err;
    EXPECT_THAT(text.out, HasSubstr("spacing       3 x 2 x 5\n              along x the mean of 1 "
                                    "to 6\nlength unit   none\nsize "));
    const auto said = nlohmann::json::parse(info({"r.vtk", "--json"}).out);
    EXPECT_EQ(said.at("uneven"), nlohmann::json::parse(R"({"x": [1.0, 6.0]})"));
}

/// `info` of files and of indices, and `build`, also as the series grows.
TEST_F(SourceInfo, SaysWhereNumbersAreMissing) {
    for (const char step : {'0', '1', '2', '3', '4'})
        folder_.write(std::string("t") + step + ".raw", std::string(60, step));
    const std::vector<std::string> raw{"--dims", "5", "4", "3", "--type", "u8"};
    const auto build = [&](const std::string& files, const std::vector<std::string>& more = {}) {
        std::vector<std::string> all{"build", files, "-o", "a.isochron"};
        all.insert(all.end(), raw.begin(), raw.end());
        all.insert(all.end(), more.begin(), more.end());
        const ChildResult result = run(all);
        EXPECT_EQ(result.status, 0) << result.err;
        return result.err;
    };
    const auto gaps = [&] {
        return nlohmann::json::parse(info({"a.isochron", "--json"}).out).at("gaps");
    };
    const std::string gap = "between steps 1 and 2 (numbers are missing in the names); there, the "
                            "step before is shown instead of a blend\n";
    const auto behind_1 =
        nlohmann::json::parse(R"([{"after_step": 1, "numbers_are_missing": true}])");
    EXPECT_THAT(build("t[013].raw"), HasSubstr("note: a gap " + gap));
    const std::string built = folder_.read("a.isochron");
    EXPECT_EQ(gaps(), behind_1);
    EXPECT_THAT(info({"a.isochron"}).out, HasSubstr("\ngaps          " + gap));
    std::vector<std::string> files{"t[013].raw"};
    files.insert(files.end(), raw.begin(), raw.end());
    EXPECT_THAT(info(files).out, HasSubstr("\ngaps          " + gap));
    build("t[0134].raw", {"--append"});
    EXPECT_EQ(gaps(), behind_1);
    std::filesystem::remove(folder_.path() / "a.isochron");
    build("t[013].raw");
    EXPECT_EQ(folder_.read("a.isochron"), built);
    EXPECT_THAT(build("t*.raw"), Not(HasSubstr("gap")));
    EXPECT_EQ(gaps(), nlohmann::json::array());
    EXPECT_THAT(info({"a.isochron"}).out, Not(HasSubstr("gaps")));
}

TEST_F(SourceInfo, SaysWhatFilesAre) {
    folder_.write("t1.raw", std::string(60, '\x05'));
    folder_.write("t2.raw", std::string(60, '\x06'));
    const ChildResult text = info(as_words("t*.raw --dims 5 4 3 --type u8"));
    EXPECT_EQ(text.status, 0) << text.err;
    EXPECT_THAT(text.out, HasSubstr("vertices      5 x 4 x 3\n"));
    EXPECT_THAT(text.out, HasSubstr("values        5 to 5 in the first step\n"));
    const ChildResult json = info(as_words("t*.raw --dims 5 4 3 --type u8 --json"));
    const auto said = nlohmann::json::parse(json.out);
    EXPECT_EQ(said["steps"], 2);
    EXPECT_EQ(said["vertices"], (std::vector<int>{5, 4, 3}));
    EXPECT_EQ(said["first_step"]["high"], 5);
    EXPECT_EQ(said["sources"], (std::vector<std::string>{"t1.raw", "t2.raw"}));
}

TEST_F(SourceInfo, ListsAllArraysWithoutAChoice) {
    const std::string flow = test_support::test_data() + "/formats/flow.vti";
    const ChildResult text = info({flow});
    EXPECT_EQ(text.status, 0) << text.err;
    EXPECT_THAT(text.out, HasSubstr("arrays        "));
    const auto said = nlohmann::json::parse(info({flow, "--json"}).out);
    EXPECT_GT(said["arrays"].size(), 1u);
}

TEST_F(SourceInfo, RefusesInOneLine) {
    const ChildResult missing = info({"nothing.vti"});
    EXPECT_EQ(missing.status, 1);
    EXPECT_EQ(std::ranges::count(missing.err, '\n'), 1);
    folder_.write("t1.raw", std::string(60, '\x05'));
    EXPECT_EQ(info(as_words("t1.raw --dims 5 4 3 --type u8 --tree")).status, 2);
}

} // namespace
} // namespace isochron::app
