// The order of the source tree: no folder includes one above it, and every file says what it is
// for.
#include "tests/house/source_tree.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace isochron::house {
namespace {

namespace fs = std::filesystem;

/// Floors that a floor may include, and single headers of others, which include no other of the
/// project.
const std::map<std::string, std::set<std::string>> kMayInclude{
    {"index", {"index"}},
    {"interaction", {"interaction", "index/volume/instant.h", "index/volume/box_cut.h"}},
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
                if (other == "tests" || (kMayInclude.contains(other) && !allowed.contains(other) &&
                                         !allowed.contains(include.path)))
                    found.push_back(file + ":" + std::to_string(include.line) + " includes " +
                                    include.path);
            }
    return found;
}

TEST(House, NoFloorLooksUpwards) {
    EXPECT_EQ(upward_includes(checkout()), std::vector<std::string>{});
    for (const char* single : {"index/volume/instant.h", "index/volume/box_cut.h"})
        for (const Include& include : includes_of(checkout() / single))
            EXPECT_TRUE(include.path.starts_with("glm/")) << single << ": " << include.path;
}

TEST(House, AnUpwardIncludeIsFound) {
    const PlantedTree tree;
    tree.plant("index/bad.cpp", "#include \"render/gl/gl.h\"\n");
    tree.plant("interaction/bad.h", "#include \"index/volume/instant.h\"\n"
                                    "#include \"index/volume/query.h\"\n");
    EXPECT_EQ(upward_includes(tree.root()),
              (std::vector<std::string>{"index/bad.cpp:1 includes render/gl/gl.h",
                                        "interaction/bad.h:2 includes index/volume/query.h"}));
}

/// Sources that print by themselves what files may have a say in.
std::vector<std::string> loose_prints(const fs::path& root) {
    constexpr std::array kCalls{
        "fmt::print", "fmt::vprint", "std::printf", "std::fprintf", "std::vprintf", "std::vfprintf",
        "std::puts",  "std::fputs",  "std::fputc",  "std::putc",    "std::fwrite",  "std::perror",
        "std::cout",  "std::cerr",   "std::clog",   " printf(",     " fprintf(",    " puts(",
        " fputs(",    " perror(",    "dprintf(",    "write(STD",    "/dev/tty",     "/dev/std"};
    const std::set<std::string> allowed{
        "app/safe_text.cpp",
        "app/command_line/progress_bar.cpp",         // moves the cursor; its words are one line
        "app/command_line/memory_shortage.cpp",      // in a handler of signals, words of its own
        "index/readers/decoders/reader_program.cpp", // words of its own
        "interaction/recording/recording.cpp",       // into a file
        "stereo/context/display_loss.cpp",           // the name of the user's own display
    };
    std::vector<std::string> found;
    for (const char* floor : kFloors)
        for (const std::string& source : sources(root, floor)) {
            std::ifstream file(root / source);
            const std::string text{std::istreambuf_iterator<char>(file), {}};
            if (!allowed.contains(source) && std::ranges::any_of(kCalls, [&](const char* call) {
                    return text.find(call) != text.npos;
                }))
                found.push_back(source);
        }
    return found;
}

TEST(House, WhatIsPrintedCannotCommandTheTerminal) {
    EXPECT_EQ(loose_prints(checkout()), std::vector<std::string>{}) << "print_safely does it";
}

TEST(House, ALoosePrintIsFound) {
    const PlantedTree tree;
    tree.plant("app/bad.cpp", "fmt::print(stderr, \"{}\", name_of(file));\n");
    tree.plant("index/bad.cpp", "::write(STDERR_FILENO, name.data(), name.size());\n");
    tree.plant("app/good.cpp", "print_safely(name_of(file));\n");
    EXPECT_EQ(loose_prints(tree.root()),
              (std::vector<std::string>{"index/bad.cpp", "app/bad.cpp"}));
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

/// Quoted includes that do not start at the root, as `file includes what`. Generated headers stand in
/// folders of the build.
std::vector<std::string> includes_not_from_root(const fs::path& root) {
    static const std::regex kQuoted(R"re(^\s*#\s*include\s*"([^"]+)")re");
    static const std::set<std::string> kGenerated{"commit.h", "version_number.h"};
    std::vector<std::string> found;
    for (const char* folder : {"app", "index", "interaction", "render", "stereo", "tests"})
        for (const std::string& source : sources(root, folder)) {
            std::ifstream file(root / source);
            std::smatch match;
            for (std::string line; std::getline(file, line);)
                if (std::regex_search(line, match, kQuoted) &&
                    !match[1].str().ends_with(".example") && !kGenerated.contains(match[1]) &&
                    !fs::exists(root / match[1].str()))
                    found.push_back(source + " includes " + match[1].str());
        }
    return found;
}

TEST(House, QuotedIncludesStartAtTheRoot) {
    EXPECT_EQ(includes_not_from_root(checkout()), std::vector<std::string>{});
}

TEST(House, ALooseIncludeIsFound) {
    const PlantedTree tree;
    tree.plant("index/far.h", "\n");
    tree.plant("stereo/loose.cpp", "#include \"screen.h\"\n#include \"index/far.h\"\n");
    EXPECT_EQ(includes_not_from_root(tree.root()),
              std::vector<std::string>{"stereo/loose.cpp includes screen.h"});
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
