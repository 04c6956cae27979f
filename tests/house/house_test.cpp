// The house stays as it was drawn: no floor looks upwards, every file says what it is for.
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace {

namespace fs = std::filesystem;

const std::map<std::string, std::set<std::string>> kMayInclude{
    {"index", {"index"}},
    {"interaction", {"interaction"}},
    {"render", {"render", "index"}},
    {"stereo", {"stereo", "render", "index", "interaction"}},
    {"app", {"app", "stereo", "render", "index", "interaction"}},
};

/// Every violation as `file:line includes what`.
std::vector<std::string> upward_includes(const fs::path& root) {
    std::vector<std::string> found;
    const std::regex include(R"(^\s*#\s*include\s*["<]([a-z]+)/)");
    for (const auto& [floor, allowed] : kMayInclude) {
        for (const auto& entry : fs::recursive_directory_iterator(root / floor)) {
            const std::string extension = entry.path().extension();
            if (extension != ".h" && extension != ".cpp")
                continue;
            std::ifstream file(entry.path());
            std::string line;
            for (int number = 1; std::getline(file, line); ++number) {
                std::smatch match;
                if (std::regex_search(line, match, include) && kMayInclude.contains(match[1]) &&
                    !allowed.contains(match[1]))
                    found.push_back(entry.path().string() + ":" + std::to_string(number) +
                                    " includes " + match[1].str());
            }
        }
    }
    return found;
}

TEST(House, NoFloorLooksUpwards) {
    EXPECT_EQ(upward_includes(isochron::test_support::source_root()), std::vector<std::string>{});
}

TEST(House, AnUpwardIncludeIsFound) {
    const fs::path root = fs::path(testing::TempDir()) / "house";
    for (const auto& [floor, allowed] : kMayInclude)
        fs::create_directories(root / floor);
    std::ofstream(root / "index" / "bad.cpp") << "#include \"render/gl/gl.h\"\n";
    EXPECT_EQ(upward_includes(root).size(), 1u);
    fs::remove_all(root);
}

TEST(House, EverySourceStartsWithItsOwnHeader) {
    for (const auto& [floor, allowed] : kMayInclude)
        for (const auto& entry :
             fs::recursive_directory_iterator(fs::path(isochron::test_support::source_root()) / floor)) {
            fs::path header = entry.path();
            header.replace_extension(".h");
            if (entry.path().extension() != ".cpp" || !fs::exists(header))
                continue;
            std::ifstream file(entry.path());
            std::string line;
            while (std::getline(file, line) && !line.starts_with("#include")) {
            }
            const std::string own = fs::relative(header, isochron::test_support::source_root()).string();
            EXPECT_EQ(line, "#include \"" + own + "\"") << "so that the header stands on its own";
        }
}

TEST(House, NoFileHoldsTwoIdeas) {
    constexpr int kMost = 400;
    for (const char* folder : {"index", "interaction", "render", "stereo", "app", "tests"})
        for (const auto& entry :
             fs::recursive_directory_iterator(fs::path(isochron::test_support::source_root()) / folder)) {
            const std::string extension = entry.path().extension();
            if (extension != ".h" && extension != ".cpp")
                continue;
            std::ifstream file(entry.path());
            const auto lines = std::count(std::istreambuf_iterator<char>(file), {}, '\n');
            EXPECT_LE(lines, kMost) << entry.path();
        }
}

TEST(House, EveryFileSaysFirstWhatItIsFor) {
    for (const auto& [floor, allowed] : kMayInclude)
        for (const auto& entry :
             fs::recursive_directory_iterator(fs::path(isochron::test_support::source_root()) / floor)) {
            const std::string extension = entry.path().extension();
            if (extension != ".h" && extension != ".cpp")
                continue;
            std::ifstream file(entry.path());
            std::string line;
            std::getline(file, line);
            EXPECT_TRUE(line.starts_with("// ")) << entry.path();
        }
}

} // namespace
