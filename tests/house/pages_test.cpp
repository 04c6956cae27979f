// The pages for users: their links and anchors lead somewhere, also where they are installed, and
// the options that they name are there.
#include "tests/house/source_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace isochron::house {
namespace {

using Findings = std::vector<std::string>;

std::string text_of_page(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The pages at the root and those below docs, as paths from `root`, sorted.
std::vector<std::string> pages_of(const std::filesystem::path& root) {
    std::vector<std::string> pages;
    for (const char* name : {"README.md", "CHANGELOG.md", "CONTRIBUTING.md"})
        if (std::filesystem::exists(root / name))
            pages.emplace_back(name);
    if (std::filesystem::exists(root / "docs"))
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "docs"))
            if (entry.path().extension() == ".md")
                pages.push_back(std::filesystem::relative(entry.path(), root).generic_string());
    std::ranges::sort(pages);
    return pages;
}

/// The lines of a page outside blocks of commands, or those inside.
std::string lines_of_page(const std::string& page, bool in_blocks) {
    std::istringstream lines(page);
    std::string text;
    bool block = false;
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("```"))
            block = !block;
        else if (block == in_blocks)
            text += line + '\n';
    return text;
}

/// The anchor of a heading, as GitHub and mkdocs make it of plain words.
std::string anchor_of(const std::string& heading) {
    std::string anchor;
    for (const char c : heading)
        if (c == ' ')
            anchor += '-';
        else if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_')
            anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return anchor;
}

std::set<std::string> anchors_in(const std::string& page) {
    std::istringstream lines(lines_of_page(page, false));
    std::set<std::string> anchors;
    for (std::string line; std::getline(lines, line);)
        if (const std::size_t end = line.find_first_not_of('#');
            end > 0 && end != std::string::npos && line[end] == ' ')
            anchors.insert(anchor_of(line.substr(end + 1)));
    return anchors;
}

/// Links and pictures whose file or anchor is not there, as `page: target`. `there` says which
/// files there are, by their paths from `root`.
template <class There>
Findings dead_links(const std::filesystem::path& root, const std::vector<std::string>& pages,
                    const There& there) {
    static const std::regex kLink(R"(\]\(([^)\s]+)\))");
    Findings dead;
    for (const std::string& page : pages) {
        const std::string text = lines_of_page(text_of_page(root / page), false);
        for (std::sregex_iterator at(text.begin(), text.end(), kLink), end; at != end; ++at) {
            const std::string target = (*at)[1].str();
            if (target.starts_with("http"))
                continue;
            const std::size_t hash = target.find('#');
            const std::filesystem::path folder = std::filesystem::path(page).parent_path();
            const std::string file =
                hash == 0 ? page
                          : (folder / target.substr(0, hash)).lexically_normal().generic_string();
            if (!there(file) ||
                (hash != std::string::npos &&
                 !anchors_in(text_of_page(root / file)).contains(target.substr(hash + 1))))
                dead.push_back(page + ": " + target);
        }
    }
    return dead;
}

Findings dead_links(const std::filesystem::path& root) {
    return dead_links(root, pages_of(root), [&](const std::string& file) {
        return std::filesystem::exists(root / file);
    });
}

TEST(Pages, EveryLinkLeadsSomewhere) {
    EXPECT_GT(pages_of(checkout()).size(), 15u);
    EXPECT_EQ(dead_links(checkout()), Findings{});
}

TEST(Pages, DeadLinksAndAnchorsAreFound) {
    const PlantedTree tree;
    tree.plant("README.md", "# Page\n[good](docs/a.md#one-two) [page](#page)\n"
                            "[gone](docs/b.md) ![no picture](docs/p.png)\n[no anchor](#two)\n"
                            "```\n[in code](nowhere)\n```\n[far](https://example.org)\n");
    tree.plant("docs/a.md", "# A\n\n## One, two\n\n[up](../README.md) [dead](README.md)\n");
    EXPECT_EQ(dead_links(tree.root()), (Findings{"README.md: docs/b.md", "README.md: docs/p.png",
                                                 "README.md: #two", "docs/a.md: README.md"}));
}

/// Rows of tables that stand apart from a table: an empty line above makes text of them.
Findings stray_rows(const std::filesystem::path& root) {
    static const std::regex kRule(R"(\|[-|: ]+\|)");
    Findings stray;
    for (const std::string& page : pages_of(root)) {
        std::istringstream lines(lines_of_page(text_of_page(root / page), false));
        std::string before, line;
        for (bool first = false; std::getline(lines, line); before = line) {
            if (first && !std::regex_match(line, kRule))
                stray.push_back(page + ": " + before);
            first = line.starts_with('|') && !before.starts_with('|');
        }
    }
    return stray;
}

TEST(Pages, NoRowStandsApartFromItsTable) {
    EXPECT_EQ(stray_rows(checkout()), Findings{});
    const PlantedTree tree;
    tree.plant("README.md", "| a | b |\n|---|---|\n| c | d |\n\n| e | f |\n\n```\n| g |\n```\n");
    EXPECT_EQ(stray_rows(tree.root()), Findings{"README.md: | e | f |"});
}

/// Lines of text that begin as an earlier line of their page does: what a merge leaves twice.
Findings lines_twice(const std::filesystem::path& root) {
    Findings twice;
    for (const std::string& page : pages_of(root)) {
        std::istringstream lines(lines_of_page(text_of_page(root / page), false));
        std::set<std::string> begun;
        for (std::string line; std::getline(lines, line);)
            if (line.size() >= 50 && page != "docs/RESULTS.md" &&
                !begun.insert(line.substr(0, 50)).second)
                twice.push_back(page + ": " + line.substr(0, 50));
    }
    return twice;
}

TEST(Pages, NoLineStandsTwiceOnOne) {
    EXPECT_EQ(lines_twice(checkout()), Findings{});
    const PlantedTree tree;
    const std::string line = "- Slices show the values on up to three planes as colors";
    tree.plant("CHANGELOG.md", line + ".\n- Short.\n- Short.\n" + line + ", with a legend.\n");
    EXPECT_EQ(lines_twice(tree.root()), Findings{"CHANGELOG.md: " + line.substr(0, 50)});
}

TEST(Pages, LinksLeadSomewhereWhereTheyAreInstalled) {
    const std::string rules = text_of_page(checkout() / "cmake/install.cmake");
    static const std::regex kFiles(
        R"(\ninstall\(FILES ([^$)]*) DESTINATION \$\{CMAKE_INSTALL_DOCDIR\} )");
    std::smatch match;
    ASSERT_TRUE(std::regex_search(rules, match, kFiles));
    std::istringstream words(match[1].str());
    const std::set<std::string> beside(std::istream_iterator<std::string>(words), {});
    ASSERT_NE(rules.find("install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs "
                         "COMPONENT program PATTERN results EXCLUDE)"),
              std::string::npos);
    const auto installed = [&](const std::string& file) {
        // The pattern leaves out folders of this name at any depth.
        return beside.contains(file) ||
               (file.starts_with("docs/") && file.find("/results/") == std::string::npos &&
                std::filesystem::exists(checkout() / file));
    };
    std::vector<std::string> pages = pages_of(checkout());
    std::erase_if(pages, [&](const std::string& page) { return !installed(page); });
    EXPECT_EQ(dead_links(checkout(), pages, installed), Findings{});
}

/// Options that a page names and no source of the program, the benchmarks or `run` has, as `page: option`.
Findings unknown_options(const std::filesystem::path& root, const std::vector<std::string>& pages) {
    static const std::regex kNamed(R"((^|[\s`(])(--[a-z][a-z-]*))");
    static const std::regex kOffered(R"([",](--[a-z][a-z-]*))");
    std::set<std::string> known{"--help", "--help-all", "--version"};
    for (const char* folder : {"app", "tests/bench"})
        for (const std::string& source : sources(root, folder)) {
            const std::string text = text_of_page(root / source);
            for (std::sregex_iterator at(text.begin(), text.end(), kOffered), end; at != end; ++at)
                known.insert((*at)[1].str());
        }
    // Options of mpirun, cmake, apt and ./run.
    known.insert({"--hostfile", "--oversubscribe", "--preset", "--target", "--install", "--build",
                  "--prefix", "--strip", "--no-install-recommends", "--serve", "--everything"});
    Findings unknown;
    for (const std::string& page : pages) {
        const std::string text = text_of_page(root / page);
        for (std::sregex_iterator at(text.begin(), text.end(), kNamed), end; at != end; ++at)
            if (const std::string option = (*at)[2].str(); !known.contains(option))
                unknown.push_back(page + ": " + option);
    }
    return unknown;
}

TEST(Pages, EveryOptionThatTheyNameIsThere) {
    std::vector<std::string> pages = pages_of(checkout());
    std::erase_if(pages, [](const std::string& page) {
        return page != "README.md" && page != "docs/README.md" && !page.starts_with("docs/guide/");
    });
    EXPECT_GT(pages.size(), 10u);
    EXPECT_EQ(unknown_options(checkout(), pages), Findings{});
}

TEST(Pages, OptionsThatNothingHasAreFound) {
    const PlantedTree tree;
    tree.plant("app/a.cpp", "option(\"-o,--out\"); flag(\"--quiet\");\n");
    tree.plant("README.md",
               "`--out FILE`, `--quiet`, `--loud`\n```sh\nisochron build --in x\n```\n");
    EXPECT_EQ(unknown_options(tree.root(), {"README.md"}),
              (Findings{"README.md: --loud", "README.md: --in"}));
}

TEST(Pages, OfTheGuideAreAllInItsContentsAndInTheSite) {
    const std::string contents = text_of_page(checkout() / "docs/README.md");
    const std::string site = text_of_page(checkout() / "packaging/mkdocs.yml");
    for (const std::string& page : pages_of(checkout()))
        if (const std::string name = page.substr(page.find('/') + 1); name.starts_with("guide/")) {
            EXPECT_NE(contents.find("(" + name + ")"), std::string::npos) << name;
            EXPECT_NE(site.find(": " + name + "\n"), std::string::npos) << name;
        }
}

} // namespace
} // namespace isochron::house
