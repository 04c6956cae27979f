// Patterns of files: brackets in the names of folders and files stand for themselves where these are there.
#include "app/indexing/file_patterns.h"

#include "index/error.h"
#include "index/name_pattern.h"
#include "tests/support/test_folder.h"

#include <gmock/gmock.h>

#include <filesystem>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

class FilePatterns : public testing::Test {
  protected:
    void write(const std::string& name) {
        fs::create_directories((folder_.path() / name).parent_path());
        folder_.write(name, "");
    }
    /// What a pattern matches, by its path in the folder.
    std::vector<std::string> matching(const std::string& pattern) {
        std::vector<std::string> found;
        for (const fs::path& file : expand_patterns({(folder_.path() / pattern).string()}))
            found.push_back(file.lexically_relative(folder_.path()).string());
        return found;
    }

    test_support::TestFolder folder_;
};

TEST_F(FilePatterns, TakeBracketsForThoseOfNamesThatAreThere) {
    for (const char* name :
         {"run[1]/o_0.vti", "run[1]/o_1.vti", "run1/o_7.vti", "a*b?[x]/deep[2]/o_3.vti",
          "o[0]_0.vti", "o[0]_1.vti", "t1.vti", "t2.vti", "t3.vti"})
        write(name);
    EXPECT_THAT(matching("run[1]/o_*.vti"), ElementsAre("run[1]/o_0.vti", "run[1]/o_1.vti"));
    EXPECT_THAT(matching("run\\[1\\]/o_[01].vti"), ElementsAre("run[1]/o_0.vti", "run[1]/o_1.vti"));
    EXPECT_THAT(matching("a*b?[x]/deep[2]/*"), ElementsAre("a*b?[x]/deep[2]/o_3.vti"));
    EXPECT_THAT(matching("*/deep[2]/*"), ElementsAre("a*b?[x]/deep[2]/o_3.vti"));
    EXPECT_THAT(matching("o[0]_*.vti"), ElementsAre("o[0]_0.vti", "o[0]_1.vti"));
    EXPECT_THAT(matching("t[12].vti"), ElementsAre("t1.vti", "t2.vti"));
    EXPECT_THAT(matching("run[1]/o_1.vti"), ElementsAre("run[1]/o_1.vti"));
    EXPECT_THROW(matching("run[1]/p_*.vti"), index::Error);
}

TEST(NamePatterns, TakeBracketsForSetsOrForThemselves) {
    EXPECT_TRUE(index::matches_pattern("Pressure [Pa]", "Pressure [Pa]"));
    EXPECT_TRUE(index::matches_pattern("*/Pressure [Pa]", "a/Pressure [Pa]"));
    EXPECT_TRUE(index::matches_pattern("t[12]", "t2"));
    EXPECT_FALSE(index::matches_pattern("t[12]", "t3"));
}

} // namespace
} // namespace isochron::app
