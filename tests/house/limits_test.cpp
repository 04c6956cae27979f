// docs/LIMITS.md names the test of each promise: all of them are there.
#include "tests/house/source_tree.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

namespace isochron::house {
namespace {

std::string read_text(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::set<std::string> tests_in(const std::filesystem::path& root) {
    static const std::regex kTest(R"(\nTEST(?:_F|_P)?\((\w+),\s*(\w+)\))");
    std::set<std::string> names;
    for (const std::string& source : sources(root, "tests")) {
        const std::string text = read_text(root / source);
        for (std::sregex_iterator found(text.begin(), text.end(), kTest), end; found != end;
             ++found)
            names.insert((*found)[1].str() + "." + (*found)[2].str());
    }
    return names;
}

/// `Suite.Name` between backquotes in the page of limits; fuzzers and files look different.
std::set<std::string> tests_named(const std::string& page) {
    static const std::regex kName(R"(`([A-Z]\w+\.[A-Z]\w+)`)");
    std::set<std::string> names;
    for (std::sregex_iterator found(page.begin(), page.end(), kName), end; found != end; ++found)
        names.insert((*found)[1].str());
    return names;
}

TEST(Limits, EveryTestThatTheyNameIsThere) {
    const std::set<std::string> there = tests_in(checkout());
    const std::set<std::string> named = tests_named(read_text(checkout() / "docs/LIMITS.md"));
    EXPECT_GT(named.size(), 40u);
    for (const std::string& name : named)
        EXPECT_TRUE(there.contains(name)) << name;
    EXPECT_FALSE(there.contains("Limits.ATestThatIsNotThere"));
}

} // namespace
} // namespace isochron::house
