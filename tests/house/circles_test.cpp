// No file includes itself through others; a header and its source count as one file.
#include "tests/house/source_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace isochron::house {
namespace {

namespace fs = std::filesystem;

/// A header with its source, by their path without extension.
using Unit = std::string;
using Arrows = std::map<Unit, std::set<Unit>>;

/// Circles by design. Each kind of GL context is a source of its own behind one header of makers,
/// which names the contexts' base; the base's source picks a maker.
const std::set<std::pair<Unit, Unit>> kByDesign{
    {"stereo/context/gl_context", "stereo/context/gl_context_backends"}};

Unit unit_of(const fs::path& file) {
    return (file.parent_path() / file.stem()).generic_string();
}

Arrows arrows_of(const fs::path& root) {
    Arrows arrows;
    for (const char* folder : {"index", "interaction", "render", "stereo", "app", "tests"})
        for (const std::string& file : sources(root, folder)) {
            const Unit from = unit_of(file);
            for (const Include& include : includes_of(root / file))
                if (const Unit to = unit_of(include.path);
                    to != from && !kByDesign.contains({from, to}))
                    arrows[from].insert(to);
        }
    return arrows;
}

/// The first circle that a walk along the arrows closes, as `a > b > a`; empty without one.
class Walk {
  public:
    explicit Walk(const Arrows& arrows) : arrows_(arrows) {}

    std::string circle() {
        for (const auto& [unit, next] : arrows_)
            if (std::string found = circle_from(unit); !found.empty())
                return found;
        return {};
    }

  private:
    std::string circle_from(const Unit& unit) {
        if (const auto first = std::ranges::find(path_, unit); first != path_.end()) {
            std::string circle;
            for (auto at = first; at != path_.end(); ++at)
                circle += *at + " > ";
            return circle + unit;
        }
        const auto next = arrows_.find(unit);
        if (next == arrows_.end() || !seen_.insert(unit).second)
            return {};
        path_.push_back(unit);
        for (const Unit& other : next->second)
            if (std::string found = circle_from(other); !found.empty())
                return found;
        path_.pop_back();
        return {};
    }

    const Arrows& arrows_;
    std::vector<Unit> path_;
    std::set<Unit> seen_;
};

std::string circle_in(const fs::path& root) {
    return Walk(arrows_of(root)).circle();
}

TEST(Circles, NoFileIncludesOneThatIncludesItBack) {
    EXPECT_EQ(circle_in(checkout()), "");
}

TEST(Circles, AStraightOneIsFound) {
    const PlantedTree tree;
    tree.plant("render/gl/a.h", "#pragma once\n");
    tree.plant("render/gl/a.cpp", "#include \"render/gl/a.h\"\n#include \"render/gl/b.h\"\n");
    tree.plant("render/gl/b.h", "#include \"render/gl/a.h\"\n");
    EXPECT_EQ(circle_in(tree.root()), "render/gl/a > render/gl/b > render/gl/a");
}

TEST(Circles, ARoundOneIsFound) {
    const PlantedTree tree;
    tree.plant("index/file/a.h", "#include \"index/file/b.h\"\n#include \"index/file/d.h\"\n");
    tree.plant("index/file/b.h", "#include \"index/file/d.h\"\n");
    tree.plant("index/file/c.h", "#include \"index/file/a.h\"\n#include \"index/file/b.h\"\n");
    EXPECT_EQ(circle_in(tree.root()), "");
    tree.plant("index/file/d.cpp", "#include \"index/file/c.h\"\n");
    EXPECT_EQ(circle_in(tree.root()),
              "index/file/a > index/file/b > index/file/d > index/file/c > index/file/a");
}

TEST(Circles, AmongTestsOneIsFoundToo) {
    const PlantedTree tree;
    tree.plant("tests/support/a.h", "#include \"tests/support/b.h\"\n");
    tree.plant("tests/support/b.h", "#include \"tests/support/a.h\"\n");
    EXPECT_EQ(circle_in(tree.root()), "tests/support/a > tests/support/b > tests/support/a");
}

TEST(Circles, TheOneByDesignIsStillThere) {
    for (const auto& [from, to] : kByDesign) {
        bool found = false;
        for (const char* extension : {".h", ".cpp"})
            for (const Include& include : includes_of(checkout() / (from + extension)))
                found = found || unit_of(include.path) == to;
        EXPECT_TRUE(found) << from << " no longer includes " << to << ": drop the exception";
    }
}

} // namespace
} // namespace isochron::house
