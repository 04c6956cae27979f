// Each commit of which docs/RESULTS.md has a measurement is one of this history, or the page says that it is
// no longer.
#include "tests/house/source_tree.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

namespace isochron::house {
namespace {

namespace fs = std::filesystem;

std::string words_of_file(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

bool git(const std::string& words) {
    const std::string command =
        "git -C '" + checkout().string() + "' " + words + " >/dev/null 2>&1";
    return std::system(command.c_str()) == 0;
}

std::set<std::string> commits_in(const std::string& text) {
    static const std::regex kCommit(R"re(\bcommit"?:? ?"?([0-9a-f]{7,40})\b)re");
    std::set<std::string> all;
    for (std::sregex_iterator found(text.begin(), text.end(), kCommit), end; found != end; ++found)
        all.insert((*found)[1]);
    return all;
}

TEST(Results, AreOfCommitsOfThisHistoryOrThePageSaysThatTheyAreNot) {
    // A tree without its history, as of an archive or a shallow clone, cannot tell.
    if (!git("rev-parse HEAD") || fs::exists(checkout() / ".git/shallow"))
        GTEST_SKIP() << "no history";
    const std::string page = words_of_file(checkout() / "docs/RESULTS.md");
    std::set<std::string> commits = commits_in(page);
    EXPECT_GT(commits.size(), 5u);
    for (const fs::directory_entry& file : fs::directory_iterator(checkout() / "docs/results"))
        commits.merge(commits_in(words_of_file(file.path())));
    for (const std::string& commit : commits)
        if (page.find("commit " + commit + ", which is no longer in the history") == page.npos)
            EXPECT_TRUE(git("merge-base --is-ancestor " + commit + " HEAD")) << commit;
    EXPECT_FALSE(git("merge-base --is-ancestor 0123456789ab HEAD"));
    EXPECT_EQ(commits_in(R"("commit":"0123456789ab", a commit 89abcdef0123)").size(), 2u);
}

} // namespace
} // namespace isochron::house
