// What CONTRIBUTING, ADDING and ARCHITECTURE name is there, and stands in a file that they name beside it.
#include "tests/house/source_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace isochron::house {
namespace {

namespace fs = std::filesystem;

using Found = std::vector<std::string>;
/// Every file of a tree that people write, with its text.
using Files = std::map<std::string, std::string>;

Files files_of(const fs::path& root) {
    Files files;
    for (const char* folder : {"app", "cmake", "configs", "docs", "index", "interaction",
                               "packaging", "render", "stereo", "tests"}) {
        if (!fs::exists(root / folder))
            continue;
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            if (!entry.is_regular_file())
                continue;
            std::ifstream file(entry.path(), std::ios::binary);
            const std::string path = fs::relative(entry.path(), root).generic_string();
            files[path] = path.starts_with("tests/data")
                              ? std::string()
                              : std::string(std::istreambuf_iterator<char>(file), {});
        }
    }
    for (const char* name : {"README.md", "CHANGELOG.md", "CONTRIBUTING.md", "CMakeLists.txt"})
        if (fs::exists(root / name)) {
            std::ifstream file(root / name);
            files[name] = std::string(std::istreambuf_iterator<char>(file), {});
        }
    return files;
}

/// The items of a page: list items, rows and paragraphs, without blocks of commands.
std::vector<std::string> items_of(const std::string& page) {
    static const std::regex kStart(R"(^(\d+\. |- |\| |#|$))");
    std::vector<std::string> items(1);
    std::istringstream lines(page);
    bool block = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("```")) {
            block = !block;
            continue;
        }
        if (block)
            continue;
        if (std::regex_search(line, kStart))
            items.emplace_back();
        items.back() += line + '\n';
    }
    return items;
}

/// A name of files as a pattern: `scene.*`, `outputs.{h,cpp}`, `bench_*.cpp`, a folder.
std::regex pattern_of(const std::string& name) {
    std::string pattern;
    for (const char c : name.ends_with('/') ? name.substr(0, name.size() - 1) : name) {
        if (c == '*')
            pattern += "[^/]*";
        else if (c == '{')
            pattern += "(";
        else if (c == '}')
            pattern += ")";
        else if (c == ',')
            pattern += "|";
        else if (c == '.')
            pattern += "\\.";
        else
            pattern += c;
    }
    return std::regex("(.*/)?" + pattern + "(/.*)?");
}

bool is_file_name(const std::string& word) {
    static const std::regex kFile(
        R"([a-z][\w/{},*-]*(/[\w{},*-]*|\.(\*|\{h,cpp\}|h|cpp|md|txt|py|frag|vert|comp|glsl|cmake|svg|json|toml))+)");
    return std::regex_match(word, kFile) && word.find("NAME") == std::string::npos;
}

/// Names of code have a capital or an underscore; other words in code letters are values and options.
bool is_name_of_code(const std::string& word) {
    static const std::regex kName(R"([A-Za-z]\w*(::\w+)*)");
    return std::regex_match(word, kName) && word.find("NAME") == std::string::npos &&
           word != "member_" && word != "kConstant" && word != "snake_case" && // how names look
           std::ranges::any_of(word, [](unsigned char c) { return c == '_' || std::isupper(c); });
}

using Words = std::unordered_set<std::string_view>;

void add_words(std::string_view text, Words& words) {
    const auto is_part = [](unsigned char c) { return c == '_' || std::isalnum(c); };
    for (auto at = text.begin(); at != text.end();) {
        const auto begin = std::find_if(at, text.end(), is_part);
        at = std::find_if_not(begin, text.end(), is_part);
        words.emplace(begin, at);
    }
}

/// Names that are nowhere, or not in the files that their item names, as `page: name: item`.
Found misplaced_names(const fs::path& root, const std::vector<std::string>& pages) {
    static const std::regex kCode("`([^`]+)`");
    const Files files = files_of(root);
    Words of_sources; // words of all sources, as most items name no file
    for (const auto& [path, text] : files)
        if (path.ends_with(".h") || path.ends_with(".cpp"))
            add_words(text, of_sources);
    Found found;
    for (const std::string& page : pages)
        for (const std::string& item : items_of(files.at(page))) {
            std::vector<std::string> names;
            Words words;
            for (std::sregex_iterator at(item.begin(), item.end(), kCode), end; at != end; ++at) {
                const std::string word = (*at)[1].str();
                if (is_name_of_code(word))
                    names.push_back(word.substr(word.rfind(':') + 1));
                if (!is_file_name(word) || word.starts_with("build/"))
                    continue;
                const std::regex pattern = pattern_of(word);
                bool there = false;
                for (const auto& [path, text] : files)
                    if (path != page && std::regex_match(path, pattern)) {
                        there = true;
                        add_words(path, words);
                        add_words(text, words);
                    }
                if (!there)
                    found.push_back(page + ": " + word + " is not there");
            }
            for (const std::string& name : names)
                if (!(words.empty() ? of_sources : words).contains(name))
                    found.push_back(page + ": " + name + " is not in the files named beside it");
        }
    return found;
}

TEST(NamedPlaces, OfTheDevelopersPagesAreThere) {
    EXPECT_EQ(misplaced_names(checkout(), {"CONTRIBUTING.md", "docs/ADDING.md", "docs/ARCHITECTURE.md"}), Found{});
}

TEST(NamedPlaces, WhatHasMovedIsFound) {
    const PlantedTree tree;
    tree.plant("index/readers/formats/known.h", "class Known;\nint count_of();\n");
    tree.plant("index/other.cpp", "int kTable = 1;\n");
    tree.plant("CONTRIBUTING.md",
               "# A page\n\n1. `index/readers/formats/known.h`: a `Known`, and `count_of`.\n"
               "2. `known.*`: a line in `kTable`.\n3. `index/gone.cpp`: more.\n"
               "\nA `kTable` is somewhere, a `kNowhere` is not.\n");
    EXPECT_EQ(misplaced_names(tree.root(), {"CONTRIBUTING.md"}),
              (Found{"CONTRIBUTING.md: kTable is not in the files named beside it",
                     "CONTRIBUTING.md: index/gone.cpp is not there",
                     "CONTRIBUTING.md: kNowhere is not in the files named beside it"}));
}

} // namespace
} // namespace isochron::house
