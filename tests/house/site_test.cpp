// The site of the pages: mkdocs makes it without a warning, its links and anchors lead somewhere, and it asks no other host.
#include "tests/house/source_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
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

std::string text_of_file(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// All first groups of a pattern in a text.
std::vector<std::string> groups_in(const std::string& text, const char* pattern) {
    const std::regex wanted(pattern);
    std::vector<std::string> found;
    for (std::sregex_iterator at(text.begin(), text.end(), wanted), end; at != end; ++at)
        found.push_back((*at)[1].str());
    return found;
}

/// The pages of a site by their paths from its root. A server shows 404.html at any address, so that
/// its links begin at the root of a server.
std::map<std::string, std::string> pages_of_site(const fs::path& site) {
    std::map<std::string, std::string> pages;
    for (const auto& entry : fs::recursive_directory_iterator(site))
        if (entry.path().extension() == ".html" && entry.path().filename() != "404.html")
            pages[fs::relative(entry.path(), site).generic_string()] = text_of_file(entry.path());
    return pages;
}

/// Links, pictures, scripts and styles that lead nowhere, as `page: target`.
std::vector<std::string> dead_ends(const fs::path& site) {
    const std::map<std::string, std::string> pages = pages_of_site(site);
    std::map<std::string, std::set<std::string>> anchors;
    for (const auto& [name, text] : pages)
        for (std::string& id : groups_in(text, R"re( id="([^"]+)")re"))
            anchors[name].insert(std::move(id));
    std::vector<std::string> dead;
    for (const auto& [name, text] : pages)
        for (const std::string& target : groups_in(text, R"re( (?:href|src)="([^"]*)")re")) {
            if (target.starts_with("http") || target.starts_with("data:"))
                continue;
            const std::size_t hash = std::min(target.find('#'), target.size());
            std::string file = hash == 0 ? name
                                         : (fs::path(name).parent_path() / target.substr(0, hash))
                                               .lexically_normal()
                                               .generic_string();
            if (fs::is_directory(site / file))
                file = (fs::path(file) / "index.html").lexically_normal().generic_string();
            const std::string anchor = hash + 1 < target.size() ? target.substr(hash + 1) : "";
            if (!fs::exists(site / file) || (!anchor.empty() && !anchors[file].contains(anchor)))
                dead.push_back(name + ": " + target);
        }
    return dead;
}

/// What a browser would fetch from another host, as `file: address`: everything but links that
/// people follow. The scripts of the theme ask other hosts for diagrams of mermaid and for facts on
/// a repository, where a page has these.
std::vector<std::string> foreign_requests(const fs::path& site) {
    std::vector<std::string> found;
    const auto take = [&](const std::string& name, const std::string& text, const char* pattern) {
        for (const std::string& address : groups_in(text, pattern))
            found.push_back(name + ": " + address);
    };
    for (const auto& [name, text] : pages_of_site(site)) {
        take(name, text, R"re( src="((?:https?:)?//[^"]*)")re");
        take(name, text, R"re(<link [^>]*href="((?:https?:)?//[^"]*)")re");
        take(name, text, R"re((class="[^"]*\bmermaid\b[^"]*"|data-md-component="source"))re");
    }
    for (const auto& entry : fs::recursive_directory_iterator(site))
        if (entry.path().extension() == ".css")
            take(fs::relative(entry.path(), site).generic_string(), text_of_file(entry.path()),
                 R"re((?:url\(|@import )["']?((?:https?:)?//[^"')]*))re");
    return found;
}

TEST(Site, IsMadeWithoutAWarningLeadsSomewhereAndAsksNoOtherHost) {
    const PlantedTree tree;
    const std::string site = (tree.root() / "site").string();
    const std::string command = "mkdocs build --quiet --strict --config-file '" +
                                (checkout() / "packaging/mkdocs.yml").string() + "' --site-dir '" +
                                site + "' >'" + site + ".log' 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0) // NOLINT(cert-env33-c): the program that makes sites
        << text_of_file(site + ".log")
        << "(mkdocs and mkdocs-material: ./run docs or ./run test install them)";
    EXPECT_GT(pages_of_site(site).size(), 15u);
    EXPECT_EQ(dead_ends(site), std::vector<std::string>{});
    EXPECT_EQ(foreign_requests(site), std::vector<std::string>{});
    EXPECT_TRUE(fs::exists(site + "/search/search_index.json"));
}

TEST(Site, DeadEndsAndForeignRequestsAreFound) {
    const PlantedTree tree;
    tree.plant("index.html", "<h1 id=\"top\"></h1><a href=\"#top\">a</a><a href=\"#gone\">b</a>"
                             "<a href=\"guide/a.html#one\">c</a><a href=\"guide/b.html\">d</a>"
                             "<a href=\"https://example.org/\">followed by people</a>"
                             "<script src=\"https://example.org/x.js\"></script>");
    tree.plant("guide/a.html", "<p id=\"one\"><img src=\"../p.png\"><a href=\"..\">up</a>"
                               "<link rel=\"stylesheet\" href=\"//example.org/s.css\">");
    tree.plant("a.css", "@import \"https://example.org/font.css\"; p { background: url(p.png) }");
    EXPECT_EQ(
        dead_ends(tree.root()),
        (std::vector<std::string>{"guide/a.html: ../p.png", "guide/a.html: //example.org/s.css",
                                  "index.html: #gone", "index.html: guide/b.html"}));
    EXPECT_EQ(foreign_requests(tree.root()),
              (std::vector<std::string>{"guide/a.html: //example.org/s.css",
                                        "index.html: https://example.org/x.js",
                                        "a.css: https://example.org/font.css"}));
}

} // namespace
} // namespace isochron::house
