// The order of the source tree: no folder includes one above it, and every file says what it is
// for.
#include "tests/house/source_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>

namespace isochron::house {
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
    for (const auto& [floor, allowed] : kMayInclude)
        for (const std::string& file : sources(root, floor))
            for (const Include& include : includes_of(root / file)) {
                const std::string other = include.path.substr(0, include.path.find('/'));
                if (other == "tests" || (kMayInclude.contains(other) && !allowed.contains(other)))
                    found.push_back(file + ":" + std::to_string(include.line) + " includes " +
                                    include.path);
            }
    return found;
}

TEST(House, NoFloorLooksUpwards) {
    EXPECT_EQ(upward_includes(checkout()), std::vector<std::string>{});
}

TEST(House, AnUpwardIncludeIsFound) {
    const PlantedTree tree;
    tree.plant("index/bad.cpp", "#include \"render/gl/gl.h\"\n");
    EXPECT_EQ(upward_includes(tree.root()),
              std::vector<std::string>{"index/bad.cpp:1 includes render/gl/gl.h"});
}

TEST(House, EverySourceStartsWithItsOwnHeader) {
    for (const char* floor : kFloors)
        for (const std::string& source : sources(checkout(), floor)) {
            const fs::path header = fs::path(source).replace_extension(".h");
            if (header == source || !fs::exists(checkout() / header))
                continue;
            std::ifstream file(checkout() / source);
            std::string line;
            while (std::getline(file, line) && !line.starts_with("#include")) {
            }
            EXPECT_EQ(line, "#include \"" + header.string() + "\"")
                << "so that the header stands on its own";
        }
}

TEST(House, NoFileHoldsTwoIdeas) {
    constexpr int kMost = 400;
    for (const char* folder : {"index", "interaction", "render", "stereo", "app", "tests"})
        for (const std::string& source : sources(checkout(), folder)) {
            std::ifstream file(checkout() / source);
            const auto lines = std::count(std::istreambuf_iterator<char>(file), {}, '\n');
            EXPECT_LE(lines, kMost) << source;
        }
}

TEST(House, EveryFileSaysFirstWhatItIsFor) {
    for (const char* floor : kFloors)
        for (const std::string& source : sources(checkout(), floor)) {
            std::ifstream file(checkout() / source);
            std::string line;
            std::getline(file, line);
            EXPECT_TRUE(line.starts_with("// ")) << source;
        }
}

} // namespace
} // namespace isochron::house
