// Each commit of which docs/RESULTS.md has a measurement is one of this history.
#include "tests/house/source_tree.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
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

/// Files measured at commits that were rewritten since; no other may be, and the page says so of each.
/// What is measured anew leaves this list.
const std::map<std::string, std::string> kLost{{"498f46717f94", "building.json"},
                                               {"69ae3ff3c705", "gpu.txt"}};

std::set<std::string> commits_in(const std::string& text) {
    static const std::regex kCommit(R"re(\bcommit"?:? ?"?([0-9a-f]{7,40})\b)re");
    std::set<std::string> all;
    for (std::sregex_iterator found(text.begin(), text.end(), kCommit), end; found != end; ++found)
        all.insert((*found)[1]);
    return all;
}

TEST(Results, AreOfCommitsOfThisHistory) {
    if (!git("rev-parse HEAD"))
        GTEST_SKIP()
            << "no history: this is no clone, so whether the commits are ancestors is unknown";
    if (git("rev-parse --is-shallow-repository | grep -q true"))
        GTEST_SKIP()
            << "a shallow clone, so whether the commits are ancestors is unknown; `git fetch "
               "--unshallow` brings the history";
    const std::string page = words_of_file(checkout() / "docs/RESULTS.md");
    std::map<std::string, std::string> commits; // and a file that names each
    for (const std::string& commit : commits_in(page))
        commits.emplace(commit, "RESULTS.md");
    EXPECT_GT(commits.size(), 5u);
    for (const fs::directory_entry& file : fs::directory_iterator(checkout() / "docs/results"))
        for (const std::string& commit : commits_in(words_of_file(file.path())))
            commits[commit] = file.path().filename().string();
    for (const auto& [commit, file] : commits) {
        const auto lost = kLost.find(commit);
        if (lost == kLost.end()) {
            EXPECT_TRUE(git("merge-base --is-ancestor " + commit + " HEAD"))
                << file << " is of commit " << commit << ", which is no ancestor of HEAD";
            continue;
        }
        EXPECT_EQ(file, lost->second);
        EXPECT_NE(page.find("commit " + commit + ", which is no longer in the history"), page.npos);
    }
    for (const auto& [commit, file] : kLost)
        EXPECT_TRUE(commits.contains(commit)) << file << " was measured anew: drop " << commit;
    EXPECT_FALSE(git("merge-base --is-ancestor 0123456789ab HEAD"));
    EXPECT_EQ(commits_in(R"("commit":"0123456789ab", a commit 89abcdef0123)").size(), 2u);
}

} // namespace
} // namespace isochron::house
