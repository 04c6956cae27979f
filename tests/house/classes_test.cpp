// No class is too large to hold in the head: one source for each, few members, short folders.
#include "tests/house/class_text.h"
#include "tests/house/source_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace isochron::house {
namespace {

namespace fs = std::filesystem;

using Found = std::vector<std::string>;

constexpr int kMostMembers = 30, kMostLines = 600, kMostFiles = 40;

std::string text_at(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Classes that have methods and too many members, as `file: Name has N members`. A record that can
/// only be compared is plain.
Found large_classes(const fs::path& root) {
    Found found;
    for (const char* floor : kFloors)
        for (const std::string& file : sources(root, floor))
            for (const ClassText& one : classes_in(text_at(root / file)))
                if (one.methods > 1 && one.members > kMostMembers)
                    found.push_back(file + ": " + one.name + " has " + std::to_string(one.members) +
                                    " members");
    return found;
}

/// Classes of a floor whose functions stand in several sources, as `floor Name: file file`.
Found scattered_classes(const fs::path& root) {
    Found found;
    for (const std::string floor : kFloors) {
        std::map<std::string, std::set<std::string>> places;
        for (const std::string& file : sources(root, floor))
            if (file.ends_with(".cpp"))
                for (const std::string& name : classes_implemented_in(text_at(root / file)))
                    places[name].insert(file);
        for (const auto& [name, files] : places) {
            std::string line = floor + " " + name + ":";
            for (const std::string& file : files)
                line += " " + file;
            if (files.size() > 1)
                found.push_back(line);
        }
    }
    return found;
}

/// Headers that are too long together with their sources, as `unit: N lines`.
Found long_units(const fs::path& root) {
    std::map<std::string, long> lines;
    for (const char* floor : kFloors)
        for (const std::string& file : sources(root, floor)) {
            const std::string text = text_at(root / file);
            lines[file.substr(0, file.rfind('.'))] += std::ranges::count(text, '\n');
        }
    Found found;
    for (const auto& [unit, count] : lines)
        if (count > kMostLines)
            found.push_back(unit + ": " + std::to_string(count) + " lines");
    return found;
}

/// Folders of sources, shaders and tests that hold too many files; data are not counted.
Found full_folders(const fs::path& root) {
    std::map<std::string, int> files;
    for (const char* floor : {"app", "index", "interaction", "render", "stereo", "tests"}) {
        if (!fs::exists(root / floor))
            continue;
        for (const auto& entry : fs::recursive_directory_iterator(root / floor)) {
            const std::string folder =
                fs::relative(entry.path().parent_path(), root).generic_string();
            if (entry.is_regular_file() && !folder.starts_with("tests/data"))
                ++files[folder];
        }
    }
    Found found;
    for (const auto& [folder, count] : files)
        if (count > kMostFiles)
            found.push_back(folder + ": " + std::to_string(count) + " files");
    return found;
}

/// Quoted includes that do not start at the root, as `file includes what`. Generated headers stand in
/// folders of the build.
Found includes_not_from_root(const fs::path& root) {
    static const std::regex kQuoted(R"re((?:^|\n)\s*#\s*include\s*"([^"]+)")re");
    static const std::set<std::string> kGenerated{"commit.h", "version_number.h"};
    Found found;
    for (const char* folder : {"app", "index", "interaction", "render", "stereo", "tests"})
        for (const std::string& file : sources(root, folder)) {
            const std::string text = text_at(root / file);
            for (std::sregex_iterator at(text.begin(), text.end(), kQuoted), end; at != end; ++at) {
                const std::string path = (*at)[1].str();
                if (!path.ends_with(".example") && !kGenerated.contains(path) &&
                    !fs::exists(root / path))
                    found.push_back(file + " includes " + path);
            }
        }
    return found;
}

TEST(Classes, OneWithMethodsHasFewMembers) {
    EXPECT_EQ(large_classes(checkout()), Found{});
}

TEST(Classes, EachIsImplementedInOneSource) {
    EXPECT_EQ(scattered_classes(checkout()), Found{});
}

TEST(Classes, AHeaderAndItsSourceAreShort) {
    EXPECT_EQ(long_units(checkout()), Found{});
}

TEST(Classes, AFolderHoldsFewFiles) {
    EXPECT_EQ(full_folders(checkout()), Found{});
}

TEST(Classes, QuotedIncludesStartAtTheRoot) {
    EXPECT_EQ(includes_not_from_root(checkout()), Found{});
}

TEST(Classes, ALargeOneIsFound) {
    const PlantedTree tree;
    std::string members, few;
    for (int i = 0; i < kMostMembers + 1; ++i) {
        (i < kMostMembers ? few : members) += "    int m" + std::to_string(i) + "_ = 0;\n";
    }
    members = few + members;
    const std::string methods = "  public:\n    int a() const { return 0; }\n    void b();\n";
    tree.plant("app/large.h", "class Large {\n" + methods + members + "};\n");
    tree.plant("app/small.h", "class Small {\n" + methods + few + "};\n");
    tree.plant("app/plain.h", "struct Plain {\n" + members + "};\n");
    EXPECT_EQ(large_classes(tree.root()), Found{"app/large.h: Large has 31 members"});
}

TEST(Classes, MembersAreCountedWithoutTheirInitializers) {
    const std::vector<ClassText> found = classes_in(R"(
/// class Not { int here; };
struct Pair {
    static constexpr int kMost = 3;
    using Map = std::map<int, int>;
    struct Inner {
        int x = 0, y = 0;
    };
    enum class Kind { one, two };
    explicit Pair(int a) : first_{a} {}
    std::function<void(int, int)> told() const;
    bool operator==(const Pair&) const = default;
    std::map<int, std::string> first_ = {}; // of ids
    std::function<void(int, int)> told_;
    double low_ = 0, high_ = f({1, 2});
    Inner inner_{.x = 1};
};
)");
    ASSERT_EQ(found.size(), 1u + 1u);
    EXPECT_EQ(found[0].name, "Pair");
    EXPECT_EQ(found[0].members, 5);
    EXPECT_EQ(found[0].methods, 3);
    EXPECT_EQ(found[1].name, "Inner");
    EXPECT_EQ(found[1].members, 2);
}

TEST(Classes, AScatteredOneIsFound) {
    const PlantedTree tree;
    tree.plant("app/a.cpp",
               "Both::Both() {}\nint Both::one() const {\n    return Other::two();\n}\n");
    tree.plant("app/b.cpp", "std::vector<int> Both::three() {\n}\nvoid Single::four() {}\n");
    EXPECT_EQ(scattered_classes(tree.root()), Found{"app Both: app/a.cpp app/b.cpp"});
}

TEST(Classes, LongUnitsFullFoldersAndLooseIncludesAreFound) {
    const PlantedTree tree;
    tree.plant("index/long.h", std::string(kMostLines / 2, '\n'));
    tree.plant("index/long.cpp", std::string(kMostLines / 2 + 1, '\n'));
    for (int i = 0; i <= kMostFiles; ++i)
        tree.plant("render/shaders/" + std::to_string(i) + ".glsl", "\n");
    tree.plant("stereo/loose.cpp", "#include \"screen.h\"\n#include \"index/long.h\"\n");
    EXPECT_EQ(long_units(tree.root()), Found{"index/long: 601 lines"});
    EXPECT_EQ(full_folders(tree.root()), Found{"render/shaders: 41 files"});
    EXPECT_EQ(includes_not_from_root(tree.root()), Found{"stereo/loose.cpp includes screen.h"});
}

} // namespace
} // namespace isochron::house
