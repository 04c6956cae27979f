// Every example in a header is also in header_examples.cpp, which compiles it.
#include "tests/house/example_text.h"
#include "tests/house/source_tree.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace isochron::house {
namespace {

namespace fs = std::filesystem;

using Found = std::vector<std::string>;

std::string text_of(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Headers with an example that no source with this text includes.
Found examples_left_out(const fs::path& root, const std::string& compiled) {
    Found found;
    for (const char* folder : {"index", "interaction", "render", "stereo", "app", "tests"})
        for (const std::string& header : sources(root, folder)) {
            if (!header.ends_with(".h") || !example_of(root / header))
                continue;
            const auto name = fs::path(header).replace_extension(".example").generic_string();
            if (compiled.find("#include \"" + name + "\"") == std::string::npos)
                found.push_back(header);
        }
    return found;
}

TEST(Examples, AllAreCompiled) {
    const std::string compiled = text_of(checkout() / "tests/house/header_examples.cpp");
    EXPECT_EQ(examples_left_out(checkout(), compiled), Found{})
        << "tests/house/header_examples.cpp needs a function for each";
}

TEST(Examples, OneThatIsLeftOutIsFound) {
    const PlantedTree tree;
    tree.plant("render/gl/a.h",
               "// What it is for.\n//\n//     A a(gl);\n//     a.draw();\n#pragma once\n");
    tree.plant("render/gl/b.h", "// What it is for.\n#pragma once\n//     not an example\n");
    EXPECT_EQ(examples_left_out(tree.root(), ""), Found{"render/gl/a.h"});
    EXPECT_EQ(examples_left_out(tree.root(), "#include \"render/gl/a.example\"\n"), Found{});
}

TEST(Examples, AreTheIndentedLinesOfTheFirstComment) {
    const PlantedTree tree;
    tree.plant("a.h",
               "// What it is for.\n//\n//     if (a)\n//         b();\n//\n// More.\n//     c();\n"
               "#pragma once\n//     no();\n");
    const auto example = example_of(tree.root() / "a.h");
    ASSERT_TRUE(example);
    EXPECT_EQ(example->line, 3);
    EXPECT_EQ(example->text, "if (a)\n    b();\n\n\nc();\n")
        << "lines stay in step with the header's";
}

} // namespace
} // namespace isochron::house
