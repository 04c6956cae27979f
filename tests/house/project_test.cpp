// What is said of the project in several places is the same: version and date, whom to ask, the licenses of libraries.
#include "tests/house/source_tree.h"

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>

namespace isochron::house {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string text_of(const char* path) {
    std::ifstream file(checkout() / path);
    EXPECT_TRUE(file) << path;
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string found_in(const std::string& text, const char* pattern) {
    std::smatch found;
    return std::regex_search(text, found, std::regex(pattern)) ? found[1].str() : "";
}

/// The settings of packaging/project.cmake.
std::map<std::string, std::string> project() {
    const std::string text = text_of("packaging/project.cmake");
    const std::regex setting("\nset\\(PROJECT_([A-Z]+) \"?([^\")]*)\"?\\)");
    std::map<std::string, std::string> settings;
    for (std::sregex_iterator each(text.begin(), text.end(), setting), end; each != end; ++each)
        settings[(*each)[1]] = (*each)[2];
    return settings;
}

TEST(Project, IsToldAlikeWherePeopleCiteIt) {
    const auto settings = project();
    const std::string citation = text_of("CITATION.cff");
    const std::string version =
        found_in(text_of("CMakeLists.txt"), "project\\(isochron VERSION ([0-9.]+)");
    ASSERT_FALSE(version.empty());
    EXPECT_THAT(citation, HasSubstr("\nversion: " + version + "\n"));
    EXPECT_THAT(citation, HasSubstr("\ndate-released: " + settings.at("RELEASED") + "\n"));
    EXPECT_THAT(citation, HasSubstr("  - name: " + settings.at("AUTHORS") + "\n"));
    EXPECT_THAT(settings.at("RELEASED"),
                testing::MatchesRegex("20[0-9][0-9]-[0-9][0-9]-[0-9][0-9]"));
}

TEST(Project, NamesAddressesWhereThereAreSomeAndNoOthers) {
    const auto settings = project();
    const std::string citation = text_of("CITATION.cff");
    const auto expect_said = [&](const char* setting, const std::string& key, const char* where) {
        const std::string& address = settings.at(setting);
        const std::string text = text_of(where);
        if (!address.empty()) {
            EXPECT_THAT(text, HasSubstr(key + address)) << where << ": " << setting;
        } else if (!key.empty()) {
            EXPECT_THAT(text, Not(HasSubstr("\n" + key))) << where << ": " << setting;
        }
    };
    expect_said("HOMEPAGE", "url: ", "CITATION.cff");
    expect_said("HOMEPAGE", "", "README.md");
    expect_said("TRACKER", "", "README.md");
    expect_said("CONTACT", "", "docs/SECURITY.md");
    EXPECT_THAT(text_of("docs/SECURITY.md"), HasSubstr("packaging/project.cmake"));
    for (const char* file : {"README.md", "CITATION.cff", "docs/SECURITY.md", "cmake/package.cmake",
                             "CONTRIBUTING.md", "setup.py", "pyproject.toml"})
        EXPECT_THAT(text_of(file), Not(HasSubstr("noreply"))) << file;
}

TEST(Licenses, OfEveryLibraryThatIsLinkedAreNamed) {
    const std::string page = text_of("docs/LICENSES.md");
    std::istringstream rows(text_of("packaging/packages.tsv"));
    int libraries = 0;
    for (std::string row; std::getline(rows, row);) {
        std::istringstream columns(row);
        std::string part, of, debian;
        std::getline(columns, part, '\t');
        std::getline(columns, of, '\t');
        std::getline(columns, debian, '\t');
        std::istringstream names(debian);
        for (std::string name; names >> name;)
            if (name.ends_with("-dev")) {
                EXPECT_THAT(page, HasSubstr("`" + name + "`")) << "docs/LICENSES.md";
                ++libraries;
            }
    }
    EXPECT_GT(libraries, 25);
}

} // namespace
} // namespace isochron::house
